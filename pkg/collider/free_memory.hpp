#pragma once
// How many interactions there is memory for.

#include <cstddef>
#include <limits>

namespace yadefrag {

/// Bytes that this process can still get: what the machine has free, and no more than limits of
/// address space and of its control group leave.
double freeMemory();

/// Remembers the answer while the scene stays of about the same size: to look it up takes as long
/// as a search among a thousand bodies.
class MemoryForPairs {
 public:
  /// Pairs that fit, with the interactions that there are.
  std::size_t most(std::size_t bodies, std::size_t interactions);

  /// What was free (bytes) when it was looked up.
  [[nodiscard]] double free() const { return free_; }

 private:
  static constexpr int kSearchesPerLookUp = 100;
  double free_ = 0;
  std::size_t interactions_ = 0, bodies_ = 0;  // when it was looked up
  int searches_ = kSearchesPerLookUp;          // since then
};

}  // namespace yadefrag
