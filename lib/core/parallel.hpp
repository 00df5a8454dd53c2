#pragma once
// The one way in which lib/ uses threads: a range is cut into contiguous parts, one per thread,
// each part appends to its own list, and the lists are joined in the order of the range. The result
// is the same, in the same order, for any number of threads.

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/tolerances.hpp"

namespace yadefrag {

/// Calls `work(begin, end, part)` for contiguous parts of [0, count) and returns how many there
/// were.
template <class Work>
int forEachPart(std::size_t count, int threads, Work work) {
  const int parts =
      std::max(1, std::min(threads, static_cast<int>(count / tolerance::kMinItemsPerThread)));
  if (parts == 1) {
    work(std::size_t{0}, count, 0);
    return 1;
  }
#pragma omp parallel for schedule(static, 1) num_threads(parts)
  for (int part = 0; part < parts; ++part)
    work(count * part / parts, count * (part + 1) / parts, part);
  return parts;
}

}  // namespace yadefrag
