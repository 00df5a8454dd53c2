#pragma once
// Memory that runs out when a test says so.

#include <cstddef>

namespace yadefrag::test {

/// While it lives, the allocation after `count` further ones of this thread throws std::bad_alloc.
class FailingMemory {
 public:
  explicit FailingMemory(std::size_t count);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
  [[nodiscard]] static bool hasFailed();
};

}  // namespace yadefrag::test
