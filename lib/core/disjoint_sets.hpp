#pragma once
// Disjoint sets of the numbers 0, 1, 2, … that are merged (Boost: union by rank, path compression).

#include <boost/pending/disjoint_sets.hpp>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace yadefrag {

/// The representative of a set depends on the order of the unions; the result of `number` does not.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }

  /// Puts each of `count` numbers into a set of its own; keeps the allocated memory.
  void reset(std::size_t count) {
    rank_.assign(count, 0);
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// The representative of the set of `member`.
  std::uint32_t find(std::uint32_t member) {
    assert(member < parent_.size());
    return sets().find_set(member);
  }
  void join(std::uint32_t a, std::uint32_t b) {
    assert(a < parent_.size() && b < parent_.size());
    sets().union_set(a, b);
  }

  /// Numbers the sets in the order of their first members; returns the number of sets.
  std::uint32_t number(std::vector<std::uint32_t>& setOfMember) {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    const std::size_t members = parent_.size();
    std::vector<std::uint32_t> numberOf(members, kNone);  // by representative
    setOfMember.resize(members);
    std::uint32_t count = 0;
    for (std::uint32_t m = 0; m < members; ++m) {
      std::uint32_t& number = numberOf[find(m)];
      if (number == kNone) number = count++;
      setOfMember[m] = number;
    }
    return count;
  }

 private:
  /// Made anew for each call: it consists of two pointers only.
  boost::disjoint_sets<std::uint8_t*, std::uint32_t*> sets() {
    return {rank_.data(), parent_.data()};
  }

  std::vector<std::uint8_t> rank_;  // at most log₂ of the number of members
  std::vector<std::uint32_t> parent_;
};

}  // namespace yadefrag
