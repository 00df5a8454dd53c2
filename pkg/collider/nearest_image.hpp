#pragma once
// Which copy of a point is nearest to another in a periodic cell.

#include <cmath>

#include "abi/yade.hpp"

namespace yadefrag {

/// The shift of `b`, in whole cells, that brings it nearest to `a`. In a sheared cell the nearest
/// copy in space need not be the nearest in the cell's own coordinates, only next to it.
inline yade::Vector3i nearestImage(const yade::Cell& cell, const yade::Vector3r& a,
                                   const yade::Vector3r& b) {
  const yade::Vector3r apart = b - a;
  const yade::Vector3r cells = cell.unshearPt(apart).cwiseQuotient(cell.getSize());
  yade::Vector3i start = -cells.array().round().matrix().cast<int>();
  if (!cell.hasShear()) return start;
  yade::Vector3i best = start;
  double least = INFINITY;
  for (int k = 0; k < 27; ++k) {
    const yade::Vector3i shift = start + yade::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const double distance = (apart + cell.intrShiftPos(shift)).squaredNorm();
    if (distance < least) {
      least = distance;
      best = shift;
    }
  }
  return best;
}

}  // namespace yadefrag
