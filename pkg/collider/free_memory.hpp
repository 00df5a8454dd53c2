#pragma once
// Number of interactions that fit into the free memory.

#include <cstddef>
#include <limits>

namespace yadefrag {

/// Bytes that this process can still allocate: the machine's free memory, within the limits of the
/// address space and of the control group.
double freeMemory();

/// Caches the free memory while the size of the scene is about constant: reading it takes as long
/// as a search among a thousand bodies.
class MemoryForPairs {
 public:
  /// Number of pairs that fit, including the present interactions.
  std::size_t most(std::size_t bodies, std::size_t interactions);

  /// Free memory (bytes) when it was last read.
  [[nodiscard]] double free() const { return free_; }

 private:
  static constexpr int kSearchesPerLookUp = 100;
  double free_ = 0;
  std::size_t interactions_ = 0, bodies_ = 0;  // when it was last read
  int searches_ = kSearchesPerLookUp;          // searches since then
};

}  // namespace yadefrag
