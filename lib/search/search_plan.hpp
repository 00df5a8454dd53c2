#pragma once
// What a code search decides from the boxes before it numbers them: box edge, axes, origin.

#include <array>
#include <span>

#include "core/box.hpp"

namespace yadefrag {

/// All of it concerns speed alone: any plan gives the same pairs. Hence a sample of the boxes will
/// do.
struct SearchPlan {
  double edge = 1;  ///< m, edge of the position-code boxes of level kBaseLevel
  std::array<double, 3> low = {0, 0, 0};  ///< m, lower corner of the sample: codes count from here
  std::array<int, 3> axes = {0, 1, 2};    ///< the axes that enter the code
  int dim = 3;                            ///< how many of them: 2 for a plane scene

  /// True if boxes numbered by this plan may stay so although `now` is what would be planned.
  [[nodiscard]] bool stillServes(const SearchPlan& now) const;
};

SearchPlan planSearch(std::span<const Box> boxes);

/// Longest side (m); infinite for a wall.
inline double longestSide(const Box& box) {
  const double x = box.max[0] - box.min[0];
  const double y = box.max[1] - box.min[1];
  const double z = box.max[2] - box.min[2];
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

}  // namespace yadefrag
