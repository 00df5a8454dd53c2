#pragma once

#include "core/parallel.hpp"

namespace yadefrag::test {

/// While it exists, even a few items are distributed to threads.
class ThreadsForFew {
 public:
  explicit ThreadsForFew(std::size_t items = 4) { leastItemsPerThread() = items; }
  ~ThreadsForFew() { leastItemsPerThread() = tolerance::kMinItemsPerThread; }
  ThreadsForFew(const ThreadsForFew&) = delete;
  ThreadsForFew& operator=(const ThreadsForFew&) = delete;
};

}  // namespace yadefrag::test
