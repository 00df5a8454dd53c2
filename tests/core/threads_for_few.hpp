#pragma once

#include "core/parallel.hpp"

namespace yadefrag::test {

/// As long as it lives, parts of a few items already are worth a thread.
class ThreadsForFew {
 public:
  explicit ThreadsForFew(std::size_t items = 4) { leastItemsPerThread() = items; }
  ~ThreadsForFew() { leastItemsPerThread() = tolerance::kMinItemsPerThread; }
  ThreadsForFew(const ThreadsForFew&) = delete;
  ThreadsForFew& operator=(const ThreadsForFew&) = delete;
};

}  // namespace yadefrag::test
