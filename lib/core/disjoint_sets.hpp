#pragma once
// Sets that grow together, of the numbers from 0 on: Boost's union by rank and path compression.

#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace yadefrag {

/// Which member stands for a set depends on how it has grown: number sets by their first member.
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

 private:
  /// Two pointers: nothing to keep.
  boost::disjoint_sets<std::uint8_t*, std::uint32_t*> sets() {
    return {rank_.data(), parent_.data()};
  }

  std::vector<std::uint8_t> rank_;  // at most log₂ of the count
  std::vector<std::uint32_t> parent_;
};

}  // namespace yadefrag
