#pragma once
// Sets that grow together, of the numbers from 0 on: Boost's union by rank and path compression.

#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/footprint.hpp"

namespace yadefrag {

/// Which member stands for a set depends on how it has grown; `number` does not.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }

  /// Each of `count` numbers in a set of its own; keeps its memory.
  void reset(std::size_t count) {
    rank_.assign(count, 0);
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  /// The member that stands for the set.
  std::uint32_t find(std::uint32_t member) { return sets().find_set(member); }
  void join(std::uint32_t a, std::uint32_t b) { sets().union_set(a, b); }

  /// Numbers the sets in the order of their first members; returns how many there are.
  std::uint32_t number(std::vector<std::uint32_t>& setOfMember) {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    const std::size_t members = parent_.size();
    std::vector<std::uint32_t> numberOf(members, kNone);  // by the member that stands for the set
    setOfMember.resize(members);
    std::uint32_t count = 0;
    for (std::uint32_t m = 0; m < members; ++m) {
      std::uint32_t& number = numberOf[find(m)];
      if (number == kNone) number = count++;
      setOfMember[m] = number;
    }
    return count;
  }

  void addTo(Footprint& footprint, Use use) const { footprint.add(use, rank_, parent_); }

 private:
  /// Two pointers: nothing to keep.
  boost::disjoint_sets<std::uint8_t*, std::uint32_t*> sets() {
    return {rank_.data(), parent_.data()};
  }

  std::vector<std::uint8_t> rank_;  // at most log₂ of the count
  std::vector<std::uint32_t> parent_;
};

}  // namespace yadefrag
