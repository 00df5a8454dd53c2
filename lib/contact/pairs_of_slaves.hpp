#pragma once
// The pairs of a step that have a row, by slave.

#include <cstdint>
#include <vector>

#include "contact/candidates.hpp"

namespace yadefrag {

/// Data of a row with a force that are stored for the next step.
struct Touch {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, start values of the next solution
  double toleratedGap;               ///< m, ≤ 0: the overlap that the row has left
};

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
  /// The number of a pair, or kNone.
  [[nodiscard]] std::uint32_t numberOf(SlaveMaster pair) const {
    std::uint32_t at = firstOf(pair.slave);
    while (at != kNone && links_[at].pair.master != pair.master) at = links_[at].next;
    return at;
  }
  static constexpr std::uint32_t kNone = 0xffffffff;

 private:
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
