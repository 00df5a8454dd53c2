#pragma once
// Equal to the last bit: what "same input, same bits" means (== would take -0 for 0).

#include <algorithm>
#include <cstring>
#include <ranges>

#include "core/parallel.hpp"

namespace yadefrag::test {

template <std::ranges::contiguous_range Range>
bool sameBits(const Range& a, const Range& b) {
  if (std::ranges::size(a) != std::ranges::size(b)) return false;
  const std::size_t bytes = std::ranges::size(a) * sizeof(std::ranges::range_value_t<Range>);
  // An empty range may have no address, which memcmp does not take.
  return bytes == 0 || std::memcmp(std::ranges::data(a), std::ranges::data(b), bytes) == 0;
}

/// While it exists, even a few items are distributed to threads.
class ThreadsForFew {
 public:
  explicit ThreadsForFew(std::size_t items = 4) { leastItemsPerThread() = items; }
  ~ThreadsForFew() { leastItemsPerThread() = tolerance::kMinItemsPerThread; }
  ThreadsForFew(const ThreadsForFew&) = delete;
  ThreadsForFew& operator=(const ThreadsForFew&) = delete;
};

}  // namespace yadefrag::test
