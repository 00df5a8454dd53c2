#include "meshing/polygon.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace yadefrag {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Loop = std::vector<Vec2>;

/// A vertex, and the edge that begins there; loop 0 is the outline.
struct Corner {
  std::size_t loop;
  std::size_t vertex;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

Point toPoint(Vec2 p) { return {p.x, p.y}; }

std::vector<Point> toPoints(const Loop& loop) {
  std::vector<Point> points;
  points.reserve(loop.size());
  for (const Vec2 p : loop) points.push_back(toPoint(p));
  return points;
}

std::string nameOf(std::size_t loop) {
  return loop == 0 ? "the outline" : fmt::format("hole {}", loop - 1);
}

std::string text(Vec2 p) { return fmt::format("({:.9g}, {:.9g})", p.x, p.y); }

class Checker {
 public:
  explicit Checker(const Polygon& polygon) {
    loops_.push_back(&polygon.outline);
    for (const Loop& hole : polygon.holes) loops_.push_back(&hole);
  }

  void check() const {
    for (std::size_t i = 0; i < loops_.size(); ++i) checkPoints(i);
    checkRepeated();
    for (std::size_t i = 0; i < loops_.size(); ++i) checkFlat(i);
    checkCrossings();
    checkArea();
    checkNesting();
  }

 private:
  [[nodiscard]] Vec2 at(Corner c) const { return (*loops_[c.loop])[c.vertex]; }

  [[nodiscard]] Corner next(Corner c) const {
    return {c.loop, c.vertex + 1 == loops_[c.loop]->size() ? 0 : c.vertex + 1};
  }

  [[nodiscard]] std::string name(Corner c) const {
    return fmt::format("vertex {} of {} at {}", c.vertex, nameOf(c.loop), text(at(c)));
  }

  void checkPoints(std::size_t loop) const {
    const Loop& points = *loops_[loop];
    if (points.size() < 3)
      throw InputError(fmt::format("Polygon: {} ends after {} {}{}; it needs at least three.",
                                   nameOf(loop), points.size(),
                                   points.size() == 1 ? "vertex" : "vertices",
                                   points.empty() ? "" : ", the last at " + text(points.back())));
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!isFinite(points[i]))
        throw InputError(fmt::format("Polygon: {} must have finite coordinates.", name({loop, i})));
  }

  void checkRepeated() const {
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      for (std::size_t k = 0; k < loops_[i]->size(); ++k) corners.push_back({i, k});
    const auto key = [&](Corner c) { return std::tuple(at(c).x, at(c).y, c); };
    std::sort(corners.begin(), corners.end(), [&](Corner a, Corner b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (at(corners[i - 1]) != at(corners[i])) continue;
      const bool closes = corners[i - 1] == Corner{corners[i].loop, 0} &&
                          corners[i].vertex + 1 == loops_[corners[i].loop]->size();
      throw InputError(fmt::format("Polygon: {} is the same point as vertex {} of {}; {}.",
                                   name(corners[i]), corners[i - 1].vertex,
                                   nameOf(corners[i - 1].loop),
                                   closes ? "a loop closes by itself, leave its last point out"
                                          : "all points must be different"));
    }
  }

  void checkFlat(std::size_t loop) const {
    const std::vector<Point> points = toPoints(*loops_[loop]);
    for (std::size_t i = 2; i < points.size(); ++i)
      if (!CGAL::collinear(points[0], points[1], points[i])) return;
    throw InputError(fmt::format(
        "Polygon: {} lies on one line with all others of {}, which must enclose an area.",
        name({loop, 0}), nameOf(loop)));
  }

  /// The first pair of edges that meet at a forbidden point.
  [[nodiscard]] std::optional<std::pair<Corner, Corner>> findCrossing() const {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Corner>;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      for (std::size_t k = 0; k < loops_[i]->size(); ++k)
        boxes.emplace_back(toPoint(at({i, k})).bbox() + toPoint(at(next({i, k}))).bbox(),
                           Corner{i, k});
    std::optional<std::pair<Corner, Corner>> first;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      const std::pair<Corner, Corner> found = std::minmax({a.info(), b.info()});
      if ((!first || found < *first) && meet(found.first, found.second)) first = found;
    });
    return first;
  }

  [[nodiscard]] bool meet(Corner a, Corner b) const {
    if (next(a) == b) return foldsBack(a);
    if (next(b) == a) return foldsBack(b);
    return CGAL::do_intersect(Kernel::Segment_2(toPoint(at(a)), toPoint(at(next(a)))),
                              Kernel::Segment_2(toPoint(at(b)), toPoint(at(next(b)))));
  }

  /// True if the edge after a's lies on a's edge.
  [[nodiscard]] bool foldsBack(Corner a) const {
    const Point from = toPoint(at(a));
    const Point tip = toPoint(at(next(a)));
    const Point to = toPoint(at(next(next(a))));
    return CGAL::collinear(from, tip, to) && !CGAL::collinear_are_ordered_along_line(from, tip, to);
  }

  void checkCrossings() const {
    const auto found = findCrossing();
    if (!found) return;
    const auto [a, b] = *found;
    throw InputError(
        fmt::format("Polygon: the edge that begins at {} meets the one that begins at {}; {}.",
                    name(a), name(b),
                    a.loop == b.loop ? "a loop must not cross or touch itself"
                                     : "loops must not cross or touch one another"));
  }

  void checkArea() const {
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      const Loop& points = *loops_[i];
      double twice = 0;
      for (std::size_t k = 2; k < points.size(); ++k)
        twice += cross(points[k - 1] - points[0], points[k] - points[0]);
      if (std::isnormal(twice)) continue;
      throw InputError(fmt::format(
          "Polygon: {}, from {} on, encloses an area that is not a usable number of square metres; "
          "coordinates are in metres.",
          nameOf(i), name({i, 0})));
    }
  }

  void checkNesting() const {
    const std::vector<Point> outline = toPoints(*loops_[0]);
    std::vector<std::vector<Point>> holes;
    std::vector<CGAL::Bbox_2> boxes;
    for (std::size_t i = 1; i < loops_.size(); ++i) {
      holes.push_back(toPoints(*loops_[i]));
      boxes.push_back(CGAL::bbox_2(holes.back().begin(), holes.back().end()));
      if (!contains(outline, holes.back().front()))
        throw InputError(
            fmt::format("Polygon: {} is outside the outline; holes must be inside.", name({i, 0})));
    }
    for (std::size_t i = 0; i < holes.size(); ++i)
      for (std::size_t k = 0; k < holes.size(); ++k)
        if (i != k && CGAL::do_overlap(boxes[i], boxes[k]) && contains(holes[k], holes[i].front()))
          throw InputError(
              fmt::format("Polygon: {} is inside hole {}; holes must be beside one another.",
                          name({i + 1, 0}), k));
  }

  [[nodiscard]] static bool contains(const std::vector<Point>& loop, const Point& point) {
    return CGAL::bounded_side_2(loop.begin(), loop.end(), point, Kernel()) == CGAL::ON_BOUNDED_SIDE;
  }

  std::vector<const Loop*> loops_;
};

void orient(Loop& loop, CGAL::Orientation wanted) {
  const std::vector<Point> points = toPoints(loop);
  if (CGAL::orientation_2(points.begin(), points.end(), Kernel()) != wanted)
    std::reverse(loop.begin() + 1, loop.end());
}

}  // namespace

Polygon checkPolygon(Polygon polygon) {
  Checker(polygon).check();
  orient(polygon.outline, CGAL::COUNTERCLOCKWISE);
  for (Loop& hole : polygon.holes) orient(hole, CGAL::CLOCKWISE);
  return polygon;
}

std::vector<Vec2> hullOf(std::vector<Vec2> points, double rounding) {
  std::ranges::sort(points, [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  for (const bool upper : {false, true}) {
    const std::size_t start = hull.size();
    for (const Vec2 point : points) {
      while (hull.size() > start &&
             (norm(point - hull.back()) <= rounding ||
              (hull.size() > start + 1 &&
               cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <=
                   rounding * norm(point - hull[hull.size() - 2]))))
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    if (!upper) std::ranges::reverse(points);
  }
  return hull;
}

double smallestWidth(std::vector<Vec2> points) {
  const std::vector<Vec2> hull = hullOf(std::move(points), 0);
  if (hull.size() < 3) return 0;
  double least = INFINITY;
  const auto at = [&](std::size_t i) { return hull[i % hull.size()]; };
  std::size_t far = 1;  // the farthest from the side; it moves on with the side
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = at(i + 1) - at(i);
    far = std::max(far, i + 1);
    while (cross(side, at(far + 1) - at(far)) > 0) ++far;
    least = std::min(least, cross(side, at(far) - at(i)) / norm(side));
  }
  return least;
}

}  // namespace yadefrag
