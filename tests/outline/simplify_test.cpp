#include "outline/simplify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "core/errors.hpp"
#include "meshing/triangulate.hpp"
#include "outline/polygon.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

/// The boundary of all pixels of side 1 whose middle is inside; every pixel corner on it is a
/// point. The longest loop first; as long as no two pixels touch at a corner only.
std::vector<Loop> pixelContour(int count, const std::function<bool(Vec2)>& inside) {
  const auto isIn = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < count && j < count && inside({i + .5, j + .5});
  };
  std::map<std::pair<int, int>, std::pair<int, int>> after;
  const auto add = [&](int a, int b, int c, int d) {
    EXPECT_TRUE(after.try_emplace({a, b}, c, d).second);
  };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      if (!isIn(i, j)) continue;
      if (!isIn(i, j - 1)) add(i, j, i + 1, j);
      if (!isIn(i + 1, j)) add(i + 1, j, i + 1, j + 1);
      if (!isIn(i, j + 1)) add(i + 1, j + 1, i, j + 1);
      if (!isIn(i - 1, j)) add(i, j + 1, i, j);
    }
  std::vector<Loop> loops;
  while (!after.empty()) {
    Loop& loop = loops.emplace_back();
    for (auto at = after.begin(); at != after.end();) {
      loop.push_back({double(at->first.first), double(at->first.second)});
      const auto next = at->second;
      after.erase(at);
      at = after.find(next);
    }
  }
  std::sort(loops.begin(), loops.end(),
            [](const Loop& a, const Loop& b) { return a.size() > b.size(); });
  return loops;
}

Polygon toPolygon(std::vector<Loop> loops) {
  return {loops.front(), {loops.begin() + 1, loops.end()}};
}

/// A disc of 90 pixels with a square hole, turned by 20°, and a round one.
Polygon pixelDisc() {
  return toPolygon(pixelContour(200, [](Vec2 p) {
    const Vec2 square = p - Vec2{70, 100};
    const double c = std::cos(.35), s = std::sin(.35);
    const bool inSquare =
        std::max(std::abs(c * square.x + s * square.y), std::abs(c * square.y - s * square.x)) < 20;
    return norm(p - Vec2{100, 100}) < 90 && !inSquare && norm(p - Vec2{145, 105}) > 15;
  }));
}

/// A square of 140 pixels, turned by 30°, with a square hole along the pixels.
Polygon pixelSquare() {
  return toPolygon(pixelContour(220, [](Vec2 p) {
    const Vec2 d = p - Vec2{110, 110};
    const double c = std::sqrt(.75), s = .5;
    return std::max(std::abs(c * d.x + s * d.y), std::abs(c * d.y - s * d.x)) < 70 &&
           std::max(std::abs(d.x), std::abs(d.y)) > 10;
  }));
}

const Loop& loopOf(const Polygon& polygon, std::size_t i) {
  return i == 0 ? polygon.outline : polygon.holes[i - 1];
}

Loop pick(const Loop& loop, const std::vector<std::uint32_t>& kept) {
  Loop result;
  for (const std::uint32_t i : kept) result.push_back(loop[i]);
  return result;
}

Polygon simplified(const Polygon& polygon, double tolerance) {
  const auto kept = verticesToKeep(polygon, tolerance);
  Polygon result{pick(polygon.outline, kept[0]), {}};
  for (std::size_t i = 1; i < kept.size(); ++i)
    result.holes.push_back(pick(polygon.holes[i - 1], kept[i]));
  return result;
}

double distanceToLoop(Vec2 p, const Loop& loop) {
  double least = INFINITY;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i], edge = loop[(i + 1) % loop.size()] - a;
    const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0., 1.);
    least = std::min(least, norm(p - a - t * edge));
  }
  return least;
}

double lengthOf(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += norm(loop[(i + 1) % loop.size()] - loop[i]);
  return sum;
}

/// Returns the share of points that stay.
double expectSimplified(const Polygon& given, double tolerance) {
  const Polygon simple = simplified(given, tolerance);
  EXPECT_EQ(simple.holes.size(), given.holes.size());
  EXPECT_NO_THROW((void)checkPolygon(simple));  // no crossings, holes inside
  double before = 0, after = 0, length = 0;
  for (std::size_t i = 0; i <= given.holes.size(); ++i) {
    const Loop& old = loopOf(given, i);
    const Loop& now = loopOf(simple, i);
    double farthest = 0;
    for (const Vec2 p : old) farthest = std::max(farthest, distanceToLoop(p, now));
    EXPECT_LE(farthest, tolerance * (1 + 1e-12));  // rounding
    length += lengthOf(old);
    before += double(old.size()), after += double(now.size());
  }
  EXPECT_LT(std::abs(area(simple) - area(given)), tolerance * length);
  return after / before;
}

TEST(Simplify, ContourOfPixelsOfADisc) {
  const Polygon disc = pixelDisc();
  ASSERT_EQ(disc.holes.size(), 2);
  // A chord of a circle of 90 may be √(8·90) = 27 long for a sagitta of 1; the pixels' own corners
  // take half of that. Measured: a ninth and a twentieth of the points.
  EXPECT_LT(expectSimplified(disc, 1), .13);
  EXPECT_LT(expectSimplified(disc, 2), .06);
  expectSimplified(disc, .3);
}

TEST(Simplify, ContourOfPixelsOfATurnedSquare) {
  const Polygon square = pixelSquare();
  ASSERT_EQ(square.holes.size(), 1);
  EXPECT_LT(expectSimplified(square, 1.5), .03);
  // Four corners, at 1.5 pixels some edges have one more.
  EXPECT_LE(simplified(square, 1.5).outline.size(), 9);
  EXPECT_EQ(simplified(square, 1e-9).holes[0].size(), 4);
}

TEST(Simplify, SameBitsTwice) {
  const Polygon disc = pixelDisc();
  const auto first = verticesToKeep(disc, .8);
  std::vector<std::vector<char>> holesInMemory;
  for (int i = 0; i < 20; ++i) {
    holesInMemory.emplace_back(std::size_t(1) << i);
    EXPECT_EQ(verticesToKeep(disc, .8), first);
  }
}

TEST(Simplify, AtAnyScale) {
  const Polygon disc = pixelDisc();
  const auto wanted = verticesToKeep(disc, .8);
  for (const double scale : {0x1p-300, 0x1p300}) {
    Polygon scaled = disc;
    for (Vec2& p : scaled.outline) p *= scale;
    for (Loop& hole : scaled.holes)
      for (Vec2& p : hole) p *= scale;
    EXPECT_EQ(verticesToKeep(scaled, .8 * scale), wanted);
  }
}

TEST(Simplify, HolesStayInside) {
  // A thin wall between a wavy outline and a hole: with the outline's tolerance alone they would
  // cross.
  Polygon polygon;
  for (int i = 0; i < 40; ++i) polygon.outline.push_back({double(i), i % 2 == 0 ? 0 : -.8});
  polygon.outline.insert(polygon.outline.end(), {{39, 20}, {0, 20}});
  Loop& hole = polygon.holes.emplace_back();
  for (int i = 39; i > 0; --i) hole.push_back({i - .01, i % 2 == 0 ? .1 : -.7});
  hole.insert(hole.end(), {{.3, 10}, {38, 10}});
  std::reverse(hole.begin(), hole.end());
  ASSERT_NO_THROW((void)checkPolygon(polygon));
  expectSimplified(polygon, 1);
}

TEST(Simplify, PinnedVerticesStay) {
  Polygon polygon{circle({0, 0}, 1, 400), {}};
  std::vector<std::uint8_t> pinned(400);
  pinned[13] = pinned[14] = pinned[399] = 1;
  const auto kept = verticesToKeep(polygon, .01, pinned)[0];
  EXPECT_LT(kept.size(), 40);
  for (const std::uint32_t i : {0u, 13u, 14u, 399u})
    EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), i)) << i;
}

TEST(Simplify, CornersBetweenLongEdgesStay) {
  const Loop outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_EQ(simplified({outline, {}}, .2).outline, outline);
}

TEST(Simplify, ASimplifiedContourMeshesAtItsSize) {
  const Polygon disc = pixelDisc();
  const TriangleMesh rough = triangulate(disc, 8.);
  const TriangleMesh even = triangulate(simplified(disc, 1), 8.);
  expectSound(even);
  EXPECT_LT(even.triangles.size(), rough.triangles.size() / 4);
}

void expectRefused(const Polygon& polygon, double tolerance, const std::string& part) {
  try {
    (void)verticesToKeep(polygon, tolerance);
    FAIL() << tolerance;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Simplify, ImpossibleArgumentsAreRefused) {
  const Polygon plate{box({0, 0}, {4, 2}), {box({1, 1}, {1.2, 1.2})}};
  for (const double wrong : {0., -1., double(INFINITY), std::numeric_limits<double>::quiet_NaN()})
    expectRefused(plate, wrong, "must be positive and finite");
  expectRefused(plate, .7, "the outline could vanish; it must be less than");
  expectRefused(plate, .05, "hole 0 could vanish; it must be less than");
  EXPECT_EQ(verticesToKeep(plate, .049)[1].size(), 4);
  expectRefused({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}, .01, "vertex");  // it crosses itself
}

}  // namespace
}  // namespace yadefrag
