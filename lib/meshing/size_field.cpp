#include "meshing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"

namespace yadefrag {

SizeField::SizeField(Vec2 low, double cell, std::uint32_t columns, std::vector<double> values)
    : low_(low), cell_(cell), columns_(columns), values_(std::move(values)) {
  if (columns < 2 || values_.size() < 2 * std::size_t{columns} || values_.size() % columns != 0 ||
      !(cell > 0) || !isFinite(low))
    throw InputError(
        "Size: its grid must have two rows and columns at least, and a positive cell.");
  for (const double value : values_)
    if (!(value > 0) || !std::isfinite(value))
      throw InputError("Size: all values must be positive and finite.");
  limitGrowth();
  const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
  smallest_ = *least;
  largest_ = *most;
}

SizeField SizeField::inUnits(double unit, Vec2 low) const {
  SizeField field = *this;
  field.smallest_ /= unit, field.largest_ /= unit, field.cell_ /= unit;
  field.low_ = (1 / unit) * (low_ - low);
  for (double& value : field.values_) value /= unit;
  return field;
}

/// Repeats forward and backward passes, as for a distance transform, until no value changes.
void SizeField::limitGrowth() {
  std::vector<double> before;
  do {
    before = values_;
    for (std::uint32_t j = 0; j < rows(); ++j)
      for (std::uint32_t i = 0; i < columns_; ++i)
        for (const auto& [di, dj] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
          relax(i, j, di, dj);
    for (std::uint32_t j = rows(); j-- > 0;)
      for (std::uint32_t i = columns_; i-- > 0;)
        for (const auto& [di, dj] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) relax(i, j, di, dj);
  } while (values_ != before);
}

void SizeField::relax(std::uint32_t i, std::uint32_t j, int di, int dj) {
  const std::uint32_t k = i + di, l = j + dj;  // a value below 0 wraps to a large number
  if (k >= columns_ || l >= rows()) return;
  const double way = cell_ * std::sqrt(static_cast<double>(di * di + dj * dj));
  double& value = values_[std::size_t{j} * columns_ + i];
  value = std::min(value, values_[std::size_t{l} * columns_ + k] + tolerance::kEdgeGrowth * way);
}

double SizeField::interpolated(Vec2 p) const {
  const double x = std::clamp((p.x - low_.x) / cell_, 0., columns_ - 1.);
  const double y = std::clamp((p.y - low_.y) / cell_, 0., rows() - 1.);
  const auto i = std::min(static_cast<std::uint32_t>(x), columns_ - 2);
  const auto j = std::min(static_cast<std::uint32_t>(y), rows() - 2);
  const double* value = &values_[std::size_t{j} * columns_ + i];
  const double u = x - i, v = y - j;
  return (1 - v) * ((1 - u) * value[0] + u * value[1]) +
         v * ((1 - u) * value[columns_] + u * value[columns_ + 1]);
}

double SizeField::trianglesInGrid() const {
  double sum = 0;
  for (std::uint32_t j = 0; j + 1 < rows(); ++j)
    for (std::uint32_t i = 0; i + 1 < columns_; ++i) {
      const double size = interpolated(low_ + cell_ * Vec2{i + .5, j + .5});
      sum += cell_ * cell_ / (std::sqrt(.1875) * size * size);
    }
  return sum;
}

}  // namespace yadefrag
