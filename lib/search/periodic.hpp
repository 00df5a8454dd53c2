#pragma once
// Searches in a periodic cell.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/ids.hpp"

namespace yadefrag {

// --- The lattice of a periodic cell: finds the nearest copy of a point for any shear of the cell.
//
// A lattice has many bases. In a cell with columns (1, 0), (7, 1) the nearest copy may be seven
// cells away; in the reduced basis (1, 0), (0, 1) it is next to the rounded coordinates.

class Lattice {
 public:
  using Vector = std::array<double, 3>;
  using Cells = std::array<int, 3>;

  /// Takes the period vectors (m). Throws InputError if they span no volume, or if the shear is
  /// beyond `tolerance::kMostShear`.
  explicit Lattice(const std::array<Vector, 3>& periods);

  /// The shift, in whole periods, with which `point` (m) is nearest to the origin.
  [[nodiscard]] Cells nearest(const Vector& point) const;

  /// Length (m) of the shortest period.
  [[nodiscard]] double shortest() const { return shortest_; }

  /// Number of periods, per axis, by which a point within half the shortest period from the origin
  /// may differ from it.
  [[nodiscard]] const Vector& reach() const { return reach_; }

 private:
  using Whole = std::array<std::int64_t, 3>;

  void reduce();
  void sortByLength();
  void reducePlane();
  bool reduceThird();
  void subtract(int from, int other, double times);
  [[nodiscard]] Cells toCells(const Whole& steps) const;

  std::array<Vector, 3> periods_;
  std::array<Vector, 3> basis_;    // reduced, shortest first
  std::array<Whole, 3> inCells_;   // vectors of the basis as sums of the periods
  std::array<Vector, 3> inverse_;  // rows: coordinates in the basis
  double shortest_ = 0;
  Vector reach_{};
};

// --- Adds copies of the boxes that protrude from a periodic cell. A search without periodicity
// then finds the pairs across the cell's faces, too.
//
// Every box is moved into the cell by whole cells, lower corner first. Where it protrudes from the
// upper face of an axis it gets a copy one cell lower. On each axis the pair (a, b) is found with
// no shift, with a shifted, or with b shifted: one for each way in which they can overlap. A pair
// with both shifted on one axis is also found without that shift; the duplicate is removed.

class PeriodicImages {
 public:
  /// Takes boxes (one per slot) and the cell's edges (m); `margin` (in cell sizes) is added around
  /// every box. Boxes as long as the cell fill their axis.
  void build(std::span<const Box> boxes, const std::array<double, 3>& size, double margin);

  /// Box i < slots is box i moved into the cell; the copies are after these.
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }

  /// Converts pairs of boxes() into pairs of slots. A pair that overlaps in two ways occurs twice.
  void toSlots(std::vector<BoxPair>& pairs) const;

  /// Per axis: the largest difference in cells between two boxes' lower corners, plus one.
  [[nodiscard]] const std::array<double, 3>& span() const { return span_; }

 private:
  struct Origin {
    std::uint32_t slot;
    std::uint32_t shifted;  // bit per axis
  };
  std::vector<Box> boxes_;
  std::vector<Origin> origins_;  // of the copies
  std::size_t slots_ = 0;
  std::array<double, 3> span_{};
};

// --- Overlap of boxes in a periodic cell, and the copy of b that overlaps a.

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
