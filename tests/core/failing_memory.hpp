#pragma once
// Memory that runs out at a moment which a test chooses.

#include <cstddef>

namespace yadefrag::test {

/// While it exists, the allocation after `count` further ones of this thread throws std::bad_alloc.
class FailingMemory {
 public:
  explicit FailingMemory(std::size_t count);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;
};

}  // namespace yadefrag::test
