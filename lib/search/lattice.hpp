#pragma once
// The lattice of a periodic cell: finds the nearest copy of a point for any shear of the cell.
//
// A lattice has many bases. In a cell with columns (1, 0), (7, 1) the nearest copy may be seven
// cells away; in the reduced basis (1, 0), (0, 1) it is next to the rounded coordinates.

#include <array>
#include <cstdint>

namespace yadefrag {

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

}  // namespace yadefrag
