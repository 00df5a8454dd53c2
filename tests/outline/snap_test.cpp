// Outlines moved onto their neighbours.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/errors.hpp"
#include "outline/polygons.hpp"
#include "outline/snap.hpp"

namespace yadefrag {
namespace {

using namespace test;

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
}  // namespace yadefrag
