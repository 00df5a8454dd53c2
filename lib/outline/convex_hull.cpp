#include "outline/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace yadefrag {

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
