#include "search/periodic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/search.hpp"

namespace yadefrag {

namespace {

using Vector = Lattice::Vector;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector plus(const Vector& a, double times, const Vector& b) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}

/// Rows of the inverse of the matrix with the given columns.
std::array<Vector, 3> inverseOf(const std::array<Vector, 3>& columns) {
  const double volume = dot(columns[0], cross(columns[1], columns[2]));
  std::array<Vector, 3> rows;
  for (int i = 0; i < 3; ++i)
    rows[i] = plus({}, 1 / volume, cross(columns[(i + 1) % 3], columns[(i + 2) % 3]));
  return rows;
}

}  // namespace

Lattice::Lattice(const std::array<Vector, 3>& periods) : periods_(periods), basis_(periods) {
  inCells_ = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const double volume = std::abs(dot(periods[0], cross(periods[1], periods[2])));
  if (!(volume > 0) || !std::isfinite(volume))
    throw InputError(
        "The periodic cell spans no volume: its period vectors lie in a plane, or are "
        "not finite.");
  reduce();
  inverse_ = inverseOf(basis_);
  shortest_ = std::sqrt(dot(basis_[0], basis_[0]));
  const std::array<Vector, 3> rows = inverseOf(periods_);
  for (int i = 0; i < 3; ++i) reach_[i] = .5 * shortest_ * std::sqrt(dot(rows[i], rows[i]));
}

/// Semaev's reduction. In the result (Minkowski-reduced) no sum or difference of two or of all
/// three vectors is shorter than the longest vector in it.
void Lattice::reduce() {
  do {
    sortByLength();
    reducePlane();
  } while (reduceThird());
}

void Lattice::sortByLength() {
  const auto swapIfLonger = [&](int a, int b) {
    if (dot(basis_[a], basis_[a]) <= dot(basis_[b], basis_[b])) return;
    std::swap(basis_[a], basis_[b]);
    std::swap(inCells_[a], inCells_[b]);
  };
  swapIfLonger(0, 1);
  swapIfLonger(1, 2);
  swapIfLonger(0, 1);
}

/// Gauss's reduction of the two shorter vectors. It terminates since each round makes one of them
/// shorter.
void Lattice::reducePlane() {
  for (;;) {
    const double before = dot(basis_[1], basis_[1]);
    const auto old = std::pair(basis_[1], inCells_[1]);
    subtract(1, 0, std::round(dot(basis_[0], basis_[1]) / dot(basis_[0], basis_[0])));
    if (!(dot(basis_[1], basis_[1]) < before)) {
      std::tie(basis_[1], inCells_[1]) = old;
      return;
    }
    if (dot(basis_[0], basis_[0]) <= dot(basis_[1], basis_[1])) return;
    std::swap(basis_[0], basis_[1]);
    std::swap(inCells_[0], inCells_[1]);
  }
}

/// Subtracts from the third vector the nearest lattice vector of the plane. Returns true if it is
/// then shorter than the second: the plane must be reduced again.
bool Lattice::reduceThird() {
  const double aa = dot(basis_[0], basis_[0]), bb = dot(basis_[1], basis_[1]);
  const double ab = dot(basis_[0], basis_[1]), det = aa * bb - ab * ab;
  const double ac = dot(basis_[0], basis_[2]), bc = dot(basis_[1], basis_[2]);
  const double x = std::round((ac * bb - bc * ab) / det), y = std::round((bc * aa - ac * ab) / det);
  double least = dot(basis_[2], basis_[2]), bestX = 0, bestY = 0;
  for (int k = 0; k < 9; ++k) {
    const int column = k % 3 - 1, row = k / 3 - 1;
    const double i = x + column, j = y + row;
    const Vector shorter = plus(plus(basis_[2], -i, basis_[0]), -j, basis_[1]);
    const double length = dot(shorter, shorter);
    if (!(length < least * (1 - tolerance::kShorterPeriod))) continue;
    least = length, bestX = i, bestY = j;
  }
  subtract(2, 0, bestX);
  subtract(2, 1, bestY);
  return (bestX != 0 || bestY != 0) && dot(basis_[2], basis_[2]) < bb;
}

/// The vector is computed again from the periods, so that errors do not accumulate.
void Lattice::subtract(int from, int other, double times) {
  if (!(std::abs(times) < tolerance::kMostShear)) {
    throw InputError(
        fmt::format("The periodic cell is sheared beyond {} cells: flip it (O.cell.flipCell).",
                    static_cast<long>(tolerance::kMostShear)));
  }
  basis_[from] = {};
  for (int i = 0; i < 3; ++i) {
    inCells_[from][i] -= static_cast<std::int64_t>(times) * inCells_[other][i];
    basis_[from] = plus(basis_[from], static_cast<double>(inCells_[from][i]), periods_[i]);
  }
}

/// Vectors of the reduced basis, each multiplied by −1, 0 or 1, lead to every neighbour whose
/// bisecting plane bounds the region of points nearest to the origin. A point is in that region if
/// none of these steps reduces its distance.
auto Lattice::nearest(const Vector& point) const -> Cells {
  Whole steps;
  Vector at = point;
  for (int i = 0; i < 3; ++i) {
    const double whole = std::round(dot(inverse_[i], point));
    steps[i] = -static_cast<std::int64_t>(whole);
    at = plus(at, -whole, basis_[i]);
  }
  double least = dot(at, at);
  while (4 * least > shortest_ * shortest_) {
    int best = -1;
    for (int k = 0; k < 27; ++k) {
      Vector moved = at;
      for (int i = 0, rest = k; i < 3; ++i, rest /= 3) moved = plus(moved, rest % 3 - 1, basis_[i]);
      const double length = dot(moved, moved);
      if (!(length < least * (1 - tolerance::kShorterPeriod))) continue;
      least = length, best = k;
    }
    if (best < 0) break;
    for (int i = 0; i < 3; ++i, best /= 3) {
      steps[i] += best % 3 - 1;
      at = plus(at, best % 3 - 1, basis_[i]);
    }
  }
  return toCells(steps);
}

auto Lattice::toCells(const Whole& steps) const -> Cells {
  Cells cells{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) cells[i] += static_cast<int>(steps[j] * inCells_[j][i]);
  return cells;
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moves the box's lower corner into [0, size); returns the shift in cells.
double wrapAxis(Box& box, int axis, double size, double margin) {
  double& low = box.min[axis];
  double& high = box.max[axis];
  if (!(high - low < size * (1 - 2 * margin))) {
    low = -kInfinity;
    high = kInfinity;
    return 0;
  }
  low -= margin * size;
  high += margin * size;
  const double cells = std::floor(low / size);
  // Rounding may put `low` slightly outside the cell: the margin covers that.
  low -= cells * size;
  high -= cells * size;
  return cells;
}

}  // namespace

void PeriodicImages::build(std::span<const Box> boxes, const std::array<double, 3>& size,
                           double margin) {
  slots_ = boxes.size();
  boxes_.assign(boxes.begin(), boxes.end());
  origins_.clear();
  std::array<double, 3> least = {kInfinity, kInfinity, kInfinity};
  std::array<double, 3> most = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < slots_; ++i) {
    if (boxes_[i].isAbsent()) continue;
    unsigned sticksOut = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cells = wrapAxis(boxes_[i], axis, size[axis], margin);
      least[axis] = std::min(least[axis], cells);
      most[axis] = std::max(most[axis], cells);
      const double high = boxes_[i].max[axis];
      if (high >= size[axis] && high < kInfinity) sticksOut |= 1U << axis;
    }
    for (unsigned shifted = 1; shifted < 8; ++shifted) {
      if ((shifted & sticksOut) != shifted) continue;
      Box copy = boxes_[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (!(shifted >> axis & 1)) continue;
        copy.min[axis] -= size[axis];
        copy.max[axis] -= size[axis];
      }
      boxes_.push_back(copy);
      origins_.push_back({static_cast<std::uint32_t>(i), shifted});
    }
  }
  for (int axis = 0; axis < 3; ++axis)
    span_[axis] = most[axis] >= least[axis] ? most[axis] - least[axis] + 1 : 0;
}

void PeriodicImages::toSlots(std::vector<BoxPair>& pairs) const {
  const auto originOf = [&](BoxId id) {
    return id.value < slots_ ? Origin{id.value, 0} : origins_[id.value - slots_];
  };
  auto kept = pairs.begin();
  for (const BoxPair& pair : pairs) {
    const Origin a = originOf(pair.first);
    const Origin b = originOf(pair.second);
    if (a.slot == b.slot || (a.shifted & b.shifted) != 0) continue;
    *kept++ = orderedPair(BoxId(a.slot), BoxId(b.slot));
  }
  pairs.erase(kept, pairs.end());
}

}  // namespace yadefrag
