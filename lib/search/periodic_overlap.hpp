#pragma once
// Overlap of boxes in a periodic cell, and the copy of b that overlaps a.

#include <array>
#include <cmath>

#include "core/box.hpp"

namespace yadefrag {

struct PeriodicOverlap {
  enum Kind { kApart, kOverlap, kTooLarge } kind = kApart;
  std::array<int, 3> shift = {0, 0, 0};  ///< b moved by this many cells overlaps a
  int axis = 0;                          ///< the axis of kTooLarge
  bool secondTooLarge = false;           ///< true: b is too large; false: a is
};

struct PeriodicRules {
  std::array<double, 3> size;  ///< m, edges of the cell
  double tolerance;            ///< in cell sizes; boxes closer than this count as overlapping
  bool allowLarge;             ///< a box too large for the cell overlaps all others along that axis
};

/// Boxes are at the bodies' positions, not wrapped. Limits as in YADE: b may extend up to half the
/// cell, a up to the whole cell. Only one copy of b can then overlap a; if two could, one is
/// chosen.
inline PeriodicOverlap periodicOverlap(const Box& a, const Box& b, const PeriodicRules& rules) {
  PeriodicOverlap out;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / rules.size[axis];
    // In cell sizes, relative to a's upper end: a is [aLow − 1, 0] and, one cell up, [aLow, 1].
    const double bLow = (b.min[axis] - a.max[axis]) * inverse;
    const double bHigh = (b.max[axis] - a.max[axis]) * inverse;
    const double aLow = 1 - (a.max[axis] - a.min[axis]) * inverse;
    // Written so that an infinite side, whose difference may be NaN, is too large.
    const bool bLarge = !(bHigh - bLow <= .5);
    if (bLarge || !(aLow >= 0)) {
      if (rules.allowLarge) continue;
      out.kind = PeriodicOverlap::kTooLarge;
      out.axis = axis;
      out.secondTooLarge = bLarge;
      return out;
    }
    const double cells = std::floor(bHigh);  // now 0 ≤ bHigh − cells < 1
    if (bLow - cells <= rules.tolerance) {
      out.shift[axis] = -static_cast<int>(cells);
    } else if (bHigh - cells + rules.tolerance >= aLow) {
      out.shift[axis] = -static_cast<int>(cells) - 1;
    } else {
      return out;
    }
  }
  out.kind = PeriodicOverlap::kOverlap;
  return out;
}

}  // namespace yadefrag
