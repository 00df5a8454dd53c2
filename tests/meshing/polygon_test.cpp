#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "core/checks.hpp"
#include "mesh/shapes.hpp"
#include "mesh/triangle_mesh.hpp"
#include "meshing/polygon.hpp"

namespace yadefrag::test {
namespace {

std::string messageFor(const Polygon& polygon) {
  return refusalOf([&] { (void)checkPolygon(polygon); });
}

const Loop kSquare = box({0, 0}, {4, 4});

TEST(Polygon, GoodOnesAreOriented) {
  Polygon polygon{kSquare, {box({1, 1}, {2, 2}), box({2.5, 1}, {3, 3})}};
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  std::reverse(polygon.holes[1].begin(), polygon.holes[1].end());
  const Polygon checked = checkPolygon(polygon);
  EXPECT_EQ(signedArea(checked.outline), 16);
  EXPECT_EQ(signedArea(checked.holes[0]), -1);
  EXPECT_EQ(signedArea(checked.holes[1]), -1);
  EXPECT_EQ(checked.outline[0], polygon.outline[0]);
  EXPECT_EQ(checked.outline[1], polygon.outline[3]);
  EXPECT_EQ(checked.holes[1], polygon.holes[1]);
}

TEST(Polygon, StraightCornersAndNeedlesAreGood) {
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, {}}), "");
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 1e-12}}, {}}), "");
  // Comparisons are exact: the tip is one unit in the last place short of the far edge, or on it.
  const double near = std::nextafter(1., 0.);
  EXPECT_EQ(messageFor({{{0, 0}, {1, 0}, {1, 1}, {near, .5}, {0, 1}}, {}}), "");
  EXPECT_NE(messageFor({{{0, 0}, {1, 0}, {1, 1}, {1, .5}, {0, 1}}, {}}), "");
}

/// The whole sentence behind "Polygon: ", or a part of it.
TEST(Polygon, WhatIsNoneIsRefused) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const std::pair<Polygon, std::string> cases[] = {
      {{{}, {}}, "the outline ends after 0 vertices; it needs at least three."},
      {{{{1, 2}}, {}},
       "the outline ends after 1 vertex, the last at (1, 2); it needs at least three."},
      {{kSquare, {{{1, 2}, {3, 2}}}},
       "hole 0 ends after 2 vertices, the last at (3, 2); it needs at least three."},
      {{{{0, 0}, {1, nan}, {1, 1}}, {}},
       "vertex 1 of the outline at (1, nan) must have finite coordinates."},
      {{kSquare, {{{1, 1}, {2, 1}, {infinite, 2}}}},
       "vertex 2 of hole 0 at (inf, 2) must have finite coordinates."},
      // Repeated points.
      {{{{0, 0}, {1, 0}, {1, 0}, {1, 1}}, {}},
       "vertex 2 of the outline at (1, 0) is the same point as vertex 1 of the outline; all points "
       "must be different."},
      {{{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, {}},
       "vertex 3 of the outline at (0, 0) is the same point as vertex 0 of the outline; a loop "
       "closes by itself, leave its last point out."},
      {{kSquare, {{{1, 1}, {2, 1}, {4, 4}}}},
       "vertex 2 of hole 0 at (4, 4) is the same point as vertex 2 of the outline; all points must "
       "be different."},
      // No area.
      {{{{0, 0}, {1, 1}, {3, 3}, {2, 2}}, {}},
       "vertex 0 of the outline at (0, 0) lies on one line with all others of the outline, which "
       "must enclose an area."},
      {{{{0, 0}, {1e-200, 0}, {0, 1e-200}}, {}}, "vertex 0"},
      {{{{0, 0}, {1e200, 0}, {0, 1e200}}, {}}, "vertex 0"},
      // Crossing itself; touching itself: a vertex on another edge, an edge that runs back on the
      // one before, a spike onto a vertex; a fold at the start.
      {{{{0, 0}, {2, 2}, {2, 0}, {0, 1}}, {}},
       "the edge that begins at vertex 0 of the outline at (0, 0) meets the one that begins at "
       "vertex 2 of the outline at (2, 0); a loop must not cross or touch itself."},
      {{{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, {}}, "vertex 0"},
      {{{{0, 0}, {4, 0}, {2, 0}, {2, 3}}, {}}, "vertex 0"},
      {{{{0, 0}, {4, 0}, {4, 4}, {4, 2}, {0, 2}}, {}}, "vertex 1"},
      {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {6, 0}}, {}}, "must not cross or touch itself"},
      // Holes outside, meeting, in one another.
      {{kSquare, {box({5, 5}, {6, 6})}},
       "vertex 0 of hole 0 at (5, 5) is outside the outline; holes must be inside."},
      {{kSquare, {box({1, 1}, {5, 2})}},
       "the edge that begins at vertex 1 of the outline at (4, 0) meets the one that begins at "
       "vertex 0 of hole 0 at (1, 1); loops must not cross or touch one another."},
      {{kSquare, {box({1, 1}, {4, 2})}}, "must not cross or touch"},
      {{kSquare, {box({-1, -1}, {5, 5})}}, "outside the outline"},
      {{kSquare, {box({1, 1}, {2, 2}), box({2, 1.5}, {3, 3})}}, "of hole 1"},
      {{kSquare, {box({1, 1}, {3, 3}), box({1.5, 1.5}, {2, 2})}},
       "vertex 0 of hole 1 at (1.5, 1.5) is inside hole 0; holes must be beside one another."},
      {{kSquare, {box({1.5, 1.5}, {2, 2}), box({1, 1}, {3, 3})}}, "of hole 0"}};
  for (const auto& [polygon, wanted] : cases) {
    const std::string text = messageFor(polygon);
    if (wanted.ends_with('.'))
      EXPECT_EQ(text, "Polygon: " + wanted);
    else
      EXPECT_TRUE(contains(text, wanted));
  }
}

TEST(Polygon, TenThousandPointsAreQuick) {
  const auto start = std::chrono::steady_clock::now();
  (void)checkPolygon({circle({0, 0}, 1, 20000), {circle({0, 0}, .5, 20000)}});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 20);  // 0.1 s where nothing else runs; every edge with every other: 100 s
}

// --- convex hull

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
      EXPECT_NEAR(smallestWidth(turnedLoop(one.points, angle)), one.width, 1e-13)
          << one.points.size() << angle;
    }
}

// --- Outlines moved onto their neighbours.

SnapSides sidesOf(const std::vector<Vec2>& loop) {
  SnapSides sides;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sides.push_back({loop[i], loop[(i + 1) % loop.size()]});
  return sides;
}

TEST(Snap, AVertexGoesToAVertexBeforeASide) {
  const Polygon beside{{{1.01, .02}, {2, 0}, {2, 1}, {.99, .5}}, {}};
  const Snapped moved = snapOnto(beside, sidesOf(box({0, 0}, {1, 1})), {.05, 0, true});
  const std::vector<Vec2> expected{{1, 0}, {2, 0}, {2, 1}, {1, .5}};
  EXPECT_EQ(moved.loops[0].points, expected);
  EXPECT_EQ(moved.count.moved, 2);
  EXPECT_EQ(moved.count.inserted, 0);
  EXPECT_DOUBLE_EQ(moved.count.farthest, std::hypot(.01, .02));
}

TEST(Snap, ACornerInASideBecomesAVertex) {
  // Inside the new outline, and outside: with matching nodes only.
  for (const double x : {1.02, .98}) {
    const SnapSides corner = sidesOf({{0, 0}, {x, .5}, {0, 1}});
    const Polygon beside{box({1, 0}, {2, 1}), {}};
    EXPECT_EQ(snapOnto(beside, corner, {.05, 0, true}).count.inserted, 1);
    const Snapped apart = snapOnto(beside, corner, {.05, 0, false});
    EXPECT_EQ(apart.count.inserted, x > 1 ? 1 : 0);
    if (x < 1) continue;
    const std::vector<Vec2> expected{{1, 0}, {2, 0}, {2, 1}, {1, 1}, {x, .5}};
    EXPECT_EQ(apart.loops[0].points, expected);
    const std::vector<std::uint32_t> vertex{0, 1, 2, 3, 3};
    EXPECT_EQ(apart.loops[0].vertex, vertex);
  }
}

TEST(Snap, VerticesThatAreNearEachOtherGiveOneVertexBehindBoth) {
  // Two bodies with a gap of .001 between them.
  SnapSides sides = sidesOf({{0, 0}, {1.003, 0}, {1.003, .5}, {0, .5}});
  for (const auto& side : sidesOf({{0, .501}, {1.006, .501}, {1.006, 1}, {0, 1}}))
    sides.push_back(side);
  const Polygon beside{box({1, -.2}, {2, 1.2}), {}};
  const Snapped moved = snapOnto(beside, sides, {.02, .02, false});
  const auto& points = moved.loops[0].points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i], b = points[(i + 1) % points.size()];
    EXPECT_GT(norm(b - a), .02);
    if (std::max(a.x, b.x) > 1.5) continue;  // not beside the two bodies
    for (const Vec2 p : {Vec2{1.003, .5}, Vec2{1.006, .501}}) EXPECT_LT(cross(b - a, p - a), 1e-9);
  }
}

TEST(Snap, HolesAndThinPolygons) {
  const Polygon plate{box({0, 0}, {4, 4}), {box({1, 1}, {3, 3})}};
  const SnapSides inside = sidesOf(box({1.01, 1.01}, {2.99, 3.01}));
  const Snapped moved = snapOnto(plate, inside, {.05, 0, true});
  EXPECT_EQ(moved.count.moved, 4);
  const auto& hole = moved.loops[1].points;
  EXPECT_EQ(std::set<double>({1.01, 2.99}), std::set<double>({hole[0].x, hole[2].x}));
  EXPECT_THROW((void)snapOnto({box({1, 1}, {1.01, 1.01}), {}}, inside, {.5, 0, true}), InputError);
  for (const double tolerance : {0., -1., double(NAN), double(INFINITY)})
    EXPECT_THROW((void)snapOnto(plate, inside, {tolerance, 0, true}), InputError);
}

/// A grid of cells with errors, and cells of twice the width between them: T-junctions.
TEST(Snap, TogetherCommonSidesHaveTheSameEnds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> error(-.01, .01);
  for (int scene = 0; scene < 10; ++scene) {
    std::vector<Polygon> cells;
    for (int row = 0; row < 6; ++row)
      for (int k = 0; k < 6 / (1 + row % 2); ++k) {
        const double wide = 1 + row % 2;
        Polygon cell{box({wide * k, double(row)}, {wide * (k + 1), row + 1.}), {}};
        for (Vec2& p : cell.outline) p += {error(random), error(random)};
        cells.push_back(cell);
      }
    std::multiset<std::array<double, 4>> sides;
    std::size_t outer = 0;
    for (const Snapped& one : snapTogether(cells, .05)) {
      const auto& loop = one.loops[0].points;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
        sides.insert({a.x, a.y, b.x, b.y});
        EXPECT_GT(norm(b - a), .5);
      }
      EXPECT_LT(one.count.farthest, .05);
    }
    for (const auto& [ax, ay, bx, by] : sides) {
      EXPECT_EQ(sides.count({ax, ay, bx, by}), 1);
      outer += 1 - sides.count({bx, by, ax, ay});
    }
    // Each side is that of two cells, except those around the whole.
    EXPECT_EQ(outer, 6 + 3 + 12);
  }
}

}  // namespace
}  // namespace yadefrag::test
