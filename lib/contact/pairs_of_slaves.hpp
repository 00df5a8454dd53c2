#pragma once
// The pairs of a step that have a row, by slave.

#include <cstdint>
#include <vector>

#include "contact/candidates.hpp"

namespace yadefrag {

/// A list of pairs with chains by slave. Nothing is cleared by entry: an index in `first_` is valid
/// if the pair there has that slave.
class PairsOfSlaves {
 public:
  void clear() { links_.clear(); }
  /// Makes room for slaves below this number.
  void grow(std::size_t entries) {
    if (first_.size() < entries) first_.resize(entries, 0);
  }
  /// The number of a pair is that of pairs added before.
  void add(SlaveMaster pair) {
    const std::uint32_t next = firstOf(pair.slave);
    first_[pair.slave.value] = static_cast<std::uint32_t>(links_.size());
    links_.push_back({pair, next});
  }
  /// True if `test(number, master)` is true for any pair of the slave.
  template <class Test>
  [[nodiscard]] bool any(EntryId slave, Test test) const {
    for (std::uint32_t i = firstOf(slave); i != kNone; i = links_[i].next)
      if (test(i, links_[i].pair.master)) return true;
    return false;
  }
  [[nodiscard]] bool contains(SlaveMaster pair) const {
    return any(pair.slave, [&](std::uint32_t, EntryId master) { return master == pair.master; });
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Link {
    SlaveMaster pair;
    std::uint32_t next;  // of the same slave
  };
  [[nodiscard]] std::uint32_t firstOf(EntryId slave) const {
    if (slave.value >= first_.size()) return kNone;
    const std::uint32_t at = first_[slave.value];
    return at < links_.size() && links_[at].pair.slave == slave ? at : kNone;
  }

  std::vector<Link> links_;
  std::vector<std::uint32_t> first_;  // by slave: its last link
};

}  // namespace yadefrag
