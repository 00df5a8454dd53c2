#include "outline/simplify.hpp"

#include <fmt/format.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/errors.hpp"
#include "core/random_bits.hpp"
#include "core/tolerances/mesh.hpp"
#include "outline/polygon.hpp"

namespace yadefrag {
namespace {

namespace simplification = CGAL::Polyline_simplification_2;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using LineVertexBase = simplification::Vertex_base_2<Kernel>;
using LineFaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using LineStorage = CGAL::Triangulation_data_structure_2<LineVertexBase, LineFaceBase>;
using Tag = CGAL::No_constraint_intersection_requiring_constructions_tag;
using LineDelaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, LineStorage, Tag>;
using LineTriangulation = CGAL::Constrained_triangulation_plus_2<LineDelaunay>;
using Loop = std::vector<Vec2>;

/// Squared distances that are made different where they are equal: CGAL would process equal ones in
/// the order of their memory addresses.
class Cost {
 public:
  /// `farthest`: the largest coordinate.
  Cost(double squaredTolerance, double farthest)
      : share_(tolerance::kEqualCosts * squaredTolerance), farthest_(farthest) {}

  /// The optional is that of Boost; since CGAL 6, that of std.
  template <class Constrained, class Iterator>
  auto operator()(const Constrained& triangulation, Iterator vertex) const {
    auto distance = simplification::Squared_distance_cost()(triangulation, vertex);
    const Kernel::Point_2& p = (*vertex)->point();
    const std::uint64_t bits = mixBits(mixBits(placeOf(p.x())) + placeOf(p.y()));
    *distance += share_ * (static_cast<double>(bits >> 12) * 0x1p-52);
    return distance;
  }

 private:
  /// The same in any unit of length.
  [[nodiscard]] std::uint64_t placeOf(double x) const {
    return static_cast<std::uint64_t>(std::llround(x / farthest_ * 0x1p26));
  }

  double share_, farthest_;
};

void checkTolerance(const Loop& loop, const std::string& name, double tolerance) {
  double twiceArea = 0, length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 from = loop[i], to = loop[(i + 1) % loop.size()];
    twiceArea += cross(from - loop[0], to - loop[0]);
    length += norm(to - from);
  }
  const double most = std::abs(twiceArea) / (2 * length);
  if (!(tolerance < most))
    throw InputError(fmt::format(
        "simplify is {:.4g} m, but {} could vanish; it must be less than that loop's area "
        "over its length, {:.4g} m.",
        tolerance, name, most));
}

class Simplification {
 public:
  /// `scale` is a power of two with which squares of the scaled coordinates do not overflow.
  Simplification(const std::vector<const Loop*>& loops, double scale,
                 std::span<const std::uint8_t> pinned)
      : loops_(loops), scale_(scale) {
    for (const Loop* loop : loops_) {
      std::vector<Kernel::Point_2> points;
      points.reserve(loop->size());
      for (const Vec2 p : *loop) {
        points.push_back(scaled(p));
        farthest_ = std::max({farthest_, std::abs(p.x * scale), std::abs(p.y * scale)});
      }
      constraints_.push_back(triangulation_.insert_constraint(points.begin(), points.end(), true));
    }
    auto vertex = triangulation_.vertices_in_constraint_begin(constraints_.front());
    for (const std::uint8_t pin : pinned) (*vertex++)->set_removable(pin == 0);
  }

  void run(double squaredTolerance) {
    simplification::simplify(triangulation_, Cost(squaredTolerance, farthest_),
                             simplification::Stop_above_cost_threshold(squaredTolerance), true);
  }

  [[nodiscard]] std::vector<std::uint32_t> kept(std::size_t loop) const {
    const Loop& all = *loops_[loop];
    std::vector<std::uint32_t> numbers;
    auto vertex = triangulation_.vertices_in_constraint_begin(constraints_[loop]);
    const auto end = triangulation_.vertices_in_constraint_end(constraints_[loop]);
    for (std::uint32_t i = 0; i < all.size() && vertex != end; ++i) {
      if (scaled(all[i]) != (*vertex)->point()) continue;
      numbers.push_back(i);
      ++vertex;
    }
    return numbers;
  }

 private:
  [[nodiscard]] Kernel::Point_2 scaled(Vec2 p) const { return {p.x * scale_, p.y * scale_}; }

  const std::vector<const Loop*>& loops_;
  double scale_, farthest_ = 0;
  LineTriangulation triangulation_;
  std::vector<LineTriangulation::Constraint_id> constraints_;
};

/// A power of two that scales all coordinates to at most 1.
double scaleOf(const std::vector<const Loop*>& loops) {
  double farthest = 0;
  for (const Loop* loop : loops)
    for (const Vec2 p : *loop) farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
  int exponent = 0;
  (void)std::frexp(farthest, &exponent);
  return std::ldexp(1, std::min(-exponent, std::numeric_limits<double>::max_exponent - 1));
}

}  // namespace

std::vector<std::vector<std::uint32_t>> verticesToKeep(const Polygon& polygon, double tolerance,
                                                       std::span<const std::uint8_t> pinned) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    throw InputError(
        fmt::format("simplify is {:.4g} m, it must be positive and finite.", tolerance));
  (void)checkPolygon(polygon);
  std::vector<const Loop*> loops{&polygon.outline};
  for (const Loop& hole : polygon.holes) loops.push_back(&hole);
  for (std::size_t i = 0; i < loops.size(); ++i)
    checkTolerance(*loops[i], i == 0 ? "the outline" : fmt::format("hole {}", i - 1), tolerance);

  const double scale = scaleOf(loops);
  Simplification simplification(loops, scale, pinned);
  simplification.run(tolerance * scale * (tolerance * scale));
  std::vector<std::vector<std::uint32_t>> kept;
  for (std::size_t i = 0; i < loops.size(); ++i) kept.push_back(simplification.kept(i));
  return kept;
}

}  // namespace yadefrag
