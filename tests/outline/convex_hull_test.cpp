#include "outline/convex_hull.hpp"

#include <gtest/gtest.h>

#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

TEST(SmallestWidth, IsThatOfTheHullInAnyPosition) {
  struct Case {
    std::vector<Vec2> points;
    double width;
  };
  const std::vector<Case> cases{
      {{{0, 0}, {4, 0}, {0, 3}, {1, 1}, {.5, .5}}, 2.4},      // the height over the side of 5
      {{{0, 0}, {5, 0}, {5, 1}, {1, 1}, {1, 2}, {0, 2}}, 2},  // an L: its hull
      {{{0, 0}, {9, 0}, {10, 1}, {1, 1}}, 1},                 // a parallelogram
      {test::circle({7, 7}, 2, 6), 2 * std::sqrt(3.)},        // a hexagon, between its sides
      {test::circle({7, 7}, 2, 3), 3},                        // a triangle: 3/2 of the radius
      {{{0, 0}, {1, 0}, {2, 0}, {2, 0}}, 0}};
  for (const Case& one : cases)
    for (const double angle : {0., .3, 1., 2.5, 4.}) {
      std::vector<Vec2> turned;
      for (const Vec2 at : one.points)
        turned.push_back({at.x * std::cos(angle) - at.y * std::sin(angle),
                          at.x * std::sin(angle) + at.y * std::cos(angle)});
      EXPECT_NEAR(smallestWidth(turned), one.width, 1e-13) << one.points.size() << angle;
    }
}

}  // namespace
}  // namespace yadefrag
