#include "outline/voronoi.hpp"

#include <fmt/format.h>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/random_bits.hpp"
#include "core/tolerances/mesh.hpp"
#include "outline/polygon.hpp"

namespace yadefrag {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Double = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactPoint = ExactKernel::Point_2;
using Shape = CGAL::Polygon_2<ExactKernel>;
using CellVertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, ExactKernel>;
using CellStorage = CGAL::Triangulation_data_structure_2<CellVertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<ExactKernel, CellStorage>;
using Loop = std::vector<Vec2>;

Shape toShape(const Loop& loop) {
  Shape shape;
  for (const Vec2 p : loop) shape.push_back({p.x, p.y});
  return shape;
}

/// Rounded only once, so that equal points give equal bits.
Loop rounded(const Shape& shape) {
  Loop loop;
  for (const ExactPoint& p : shape.container()) {
    const Vec2 at{CGAL::to_double(p.x().exact()), CGAL::to_double(p.y().exact())};
    if (loop.empty() || loop.back() != at) loop.push_back(at);
  }
  if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  return loop;
}

/// The part of a convex shape that is nearer to `own` than to `other`.
Shape nearerHalf(const Shape& shape, const ExactPoint& own, const ExactPoint& other) {
  const ExactKernel::Line_2 bisector = CGAL::bisector(own, other);  // `own` is on its left
  Shape half;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const ExactPoint& a = shape[i];
    const ExactPoint& b = shape[(i + 1) % shape.size()];
    const auto sideOfA = bisector.oriented_side(a), sideOfB = bisector.oriented_side(b);
    if (sideOfA != CGAL::ON_NEGATIVE_SIDE) half.push_back(a);
    if (sideOfA * sideOfB >= 0) continue;
    const auto crossing = CGAL::intersection(bisector, ExactKernel::Line_2(a, b));
    half.push_back(get<ExactPoint>(*crossing));  // Boost's variant; since CGAL 6, that of std
  }
  return half;
}

class Grains {
 public:
  Grains(const Loop& outline, std::uint32_t count, std::uint64_t seed)
      : outline_(toShape(outline)), random_(seed) {
    for (const Vec2 p : outline) corners_.emplace_back(p.x, p.y);
    low_ = high_ = outline.front();
    for (const Vec2 p : outline) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    if (!isFinite(2 * high_ - low_) || !isFinite(2 * low_ - high_))
      throw InputError("The outline has coordinates that are too large for grains.");
    scatter(count);
  }

  /// Moves each point to the centroid of its grain. A centroid outside the outline is not used.
  void even() {
    const auto cells = grains();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      double twiceArea = 0;
      Vec2 moment;  // relative to the point, which reduces rounding
      for (const Loop& grain : cells[i])
        for (std::size_t k = 0; k < grain.size(); ++k) {
          const Vec2 a = grain[k] - places_[i], b = grain[(k + 1) % grain.size()] - places_[i];
          twiceArea += cross(a, b);
          moment += cross(a, b) / 3 * (a + b);
        }
      if (!(twiceArea > 0)) continue;
      const Vec2 middle = places_[i] + (1 / twiceArea) * moment;
      if (isInside(middle)) places_[i] = middle;
    }
  }

  /// The grains of each point.
  [[nodiscard]] std::vector<std::vector<Loop>> grains() const {
    Delaunay delaunay;
    std::vector<Delaunay::Vertex_handle> vertices;
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      vertices.push_back(delaunay.insert(ExactPoint(places_[i].x, places_[i].y)));
      vertices.back()->info() = i;
    }
    std::vector<std::vector<Loop>> all(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::vector<CGAL::Polygon_with_holes_2<ExactKernel>> parts;
      CGAL::intersection(cellOf(delaunay, vertices[i]), outline_, std::back_inserter(parts));
      for (const auto& part : parts) {
        Loop grain = rounded(part.outer_boundary());
        if (grain.size() >= 3) all[i].push_back(std::move(grain));
      }
      // CGAL's order is that of a map and may vary: sort.
      std::sort(all[i].begin(), all[i].end(), [](const Loop& a, const Loop& b) {
        return std::pair(a[0].x, a[0].y) < std::pair(b[0].x, b[0].y);
      });
    }
    return all;
  }

 private:
  void scatter(std::uint32_t count) {
    std::set<std::pair<double, double>> known;
    for (int tries = 0; places_.size() < count; ++tries) {
      if (tries == tolerance::kPlaceTries)
        throw InputError(fmt::format(
            "The outline has no room for {} grains: it is too thin, or too far from the origin.",
            count));
      const Vec2 way{(random_.symmetric() + 1) / 2, (random_.symmetric() + 1) / 2};
      const Vec2 p{low_.x + way.x * (high_.x - low_.x), low_.y + way.y * (high_.y - low_.y)};
      if (!isInside(p) || !known.insert({p.x, p.y}).second) continue;
      places_.push_back(p);
      tries = 0;
    }
  }

  [[nodiscard]] bool isInside(Vec2 p) const {
    return CGAL::bounded_side_2(corners_.begin(), corners_.end(), Double::Point_2(p.x, p.y),
                                Double()) == CGAL::ON_BOUNDED_SIDE;
  }

  [[nodiscard]] Shape cellOf(const Delaunay& delaunay, Delaunay::Vertex_handle own) const {
    const Vec2 wide = high_ - low_;
    Shape cell = toShape({low_ - wide,
                          {high_.x + wide.x, low_.y - wide.y},
                          high_ + wide,
                          {low_.x - wide.x, high_.y + wide.y}});
    if (delaunay.number_of_vertices() < 2) return cell;
    auto neighbour = delaunay.incident_vertices(own);
    const auto first = neighbour;
    do
      if (!delaunay.is_infinite(neighbour))
        cell = nearerHalf(cell, own->point(), neighbour->point());
    while (++neighbour != first);
    return cell;
  }

  Shape outline_;
  std::vector<Double::Point_2> corners_;  // corners of the outline
  RandomSequence random_;
  Vec2 low_, high_;  // bounding box of the outline
  std::vector<Vec2> places_;
};

}  // namespace

std::vector<std::vector<Vec2>> voronoiGrains(const std::vector<Vec2>& outline, std::uint32_t count,
                                             std::uint64_t seed, int rounds) {
  Grains grains(checkPolygon({outline, {}}).outline, count, seed);
  for (int i = 0; i < rounds; ++i) grains.even();
  std::vector<Loop> all;
  for (auto& cell : grains.grains())
    for (Loop& grain : cell) all.push_back(std::move(grain));
  return all;
}

}  // namespace yadefrag
