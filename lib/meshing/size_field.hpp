#pragma once
// The desired edge length, constant or by position.

#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

class SizeField {
 public:
  /// `size` (m) at every point.
  SizeField(double size) : smallest_(size), largest_(size) {}  // NOLINT(*-explicit-*): one number

  /// `values` (m) at the points low + cell·(i, j), row by row, `columns` in each. Linear
  /// interpolation between them, constant extrapolation beyond them. Values that grow by more than
  /// tolerance::kEdgeGrowth per metre are lowered. Throws InputError if a value is not positive and
  /// finite, and for fewer than two rows or columns.
  SizeField(Vec2 low, double cell, std::uint32_t columns, std::vector<double> values);

  /// These sizes in another unit (m), with the origin at `low`.
  [[nodiscard]] SizeField inUnits(double unit, Vec2 low) const;

  [[nodiscard]] bool isEven() const { return values_.empty(); }
  [[nodiscard]] double at(Vec2 p) const { return isEven() ? smallest_ : interpolated(p); }
  [[nodiscard]] double smallest() const { return smallest_; }
  [[nodiscard]] double largest() const { return largest_; }

  /// Number of equilateral triangles that would fill the grid's rectangle.
  [[nodiscard]] double trianglesInGrid() const;

 private:
  [[nodiscard]] double interpolated(Vec2 p) const;
  [[nodiscard]] std::uint32_t rows() const {
    return static_cast<std::uint32_t>(values_.size()) / columns_;
  }
  void limitGrowth();
  void relax(std::uint32_t i, std::uint32_t j, int di, int dj);

  double smallest_, largest_;
  Vec2 low_;
  double cell_ = 0;
  std::uint32_t columns_ = 0;
  std::vector<double> values_;
};

}  // namespace yadefrag
