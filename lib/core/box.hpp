#pragma once
// Axis-aligned boxes: the input of every search.

#include <array>
#include <cmath>
#include <limits>

#include "core/request.hpp"

namespace yadefrag {

/// A closed axis-aligned box (m). A point is a box of size 0; a wall has infinite sides.
struct Box {
  std::array<double, 3> min;
  std::array<double, 3> max;

  /// The box of an empty slot. It overlaps no box, itself included.
  static constexpr Box absent() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }
  [[nodiscard]] bool isAbsent() const { return min[0] > max[0]; }
};

/// True if the closed boxes share a point. Bitwise `&`: six independent comparisons are faster than
/// up to six mispredicted branches.
inline bool overlaps(const Box& a, const Box& b) {
  return bool((a.min[0] <= b.max[0]) & (b.min[0] <= a.max[0]) & (a.min[1] <= b.max[1]) &
              (b.min[1] <= a.max[1]) & (a.min[2] <= b.max[2]) & (b.min[2] <= a.max[2]));
}

/// A box may lie in two cache lines.
inline void prefetch(const Box& box) {
  requestLine(&box);
  requestLine(&box.max[2]);
}

}  // namespace yadefrag
