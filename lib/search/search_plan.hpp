#pragma once
// Parameters that a code search derives from the boxes before numbering them: box edge, axes,
// origin.

#include <array>
#include <cmath>
#include <span>

#include "core/box.hpp"

namespace yadefrag {

/// These parameters affect speed only: any plan gives the same pairs. A sample of the boxes is
/// therefore sufficient.
struct SearchPlan {
  double extent = 1;                      ///< m, longest side on level kBaseLevel
  std::array<double, 3> low = {0, 0, 0};  ///< m, lower corner of the sample, origin of the codes
  std::array<int, 3> axes = {0, 1, 2};    ///< the axes that enter the code
  int dim = 3;                            ///< number of these axes: 2 for a plane scene
  bool isEven = false;                    ///< true if enough boxes are on level kBaseLevel

  /// True if boxes numbered by this plan may keep their numbers although `now` would be planned
  /// today.
  [[nodiscard]] bool stillServes(const SearchPlan& now) const;
};

/// If one level can have at least the part `leastEven` of the boxes, that one is kBaseLevel, with
/// the extent `extentBefore` (m; 0: none) if that one serves about as many; otherwise the one of
/// the median.
SearchPlan planSearch(std::span<const Box> boxes, double leastEven = INFINITY,
                      double extentBefore = 0);

/// Longest side (m); infinite for a wall.
inline double longestSide(const Box& box) {
  const double x = box.max[0] - box.min[0];
  const double y = box.max[1] - box.min[1];
  const double z = box.max[2] - box.min[2];
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

}  // namespace yadefrag
