#include "outline/voronoi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "core/errors.hpp"
#include "outline/polygon.hpp"
#include "outline/polygons.hpp"

namespace yadefrag {
namespace {

using namespace test;

const Loop kAngle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

bool contains(const Loop& loop, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      inside = !inside;
  }
  return inside;
}

/// Grains are simple, fill the outline, and share sides bit by bit; no point is in two of them.
void expectGrains(const Loop& outline, const std::vector<Loop>& grains) {
  double sum = 0, length = 0, shared = 0;
  std::map<std::pair<std::pair<double, double>, std::pair<double, double>>, int> sides;
  for (const Loop& grain : grains) {
    ASSERT_NO_THROW((void)checkPolygon({grain, {}}));
    EXPECT_GT(signedArea(grain), 0);
    sum += signedArea(grain);
    for (std::size_t i = 0; i < grain.size(); ++i) {
      const Vec2 a = grain[i], b = grain[(i + 1) % grain.size()];
      ++sides[{{a.x, a.y}, {b.x, b.y}}];
    }
  }
  const double whole = std::abs(signedArea(outline));
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
  for (std::size_t i = 0; i < outline.size(); ++i)
    length += norm(outline[(i + 1) % outline.size()] - outline[i]);
  double alone = 0;
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    const auto& [a, b] = side;
    const double own = std::hypot(a.first - b.first, a.second - b.second);
    (sides.contains({b, a}) ? shared : alone) += own;
  }
  EXPECT_NEAR(alone, length, 1e-12 * length);  // all others have a neighbour
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-.2, 2.2);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p{any(random), any(random)};
    const auto owners =
        std::ranges::count_if(grains, [&](const Loop& grain) { return contains(grain, p); });
    EXPECT_EQ(owners, contains(outline, p) ? 1 : 0);
  }
}

double spread(const std::vector<Loop>& grains) {
  double sum = 0, squares = 0;
  for (const Loop& grain : grains) {
    sum += signedArea(grain);
    squares += signedArea(grain) * signedArea(grain);
  }
  const double mean = sum / double(grains.size());
  return std::sqrt(squares / double(grains.size()) / (mean * mean) - 1);
}

TEST(Voronoi, GrainsFillConvexAndConcaveOutlines) {
  for (const std::uint32_t count : {1U, 2U, 3U, 10U, 200U}) {
    expectGrains(box({0, 0}, {2, 1}), voronoiGrains(box({0, 0}, {2, 1}), count, 3));
    expectGrains(kAngle, voronoiGrains(kAngle, count, 4));
    expectGrains(circle({1, 1}, 1, 40), voronoiGrains(circle({1, 1}, 1, 40), count, 5));
  }
  std::mt19937 random(7);
  for (int i = 0; i < 5; ++i) {
    const Loop outline = star(random, 30, .3);
    expectGrains(outline, voronoiGrains(outline, 40, i));
  }
  EXPECT_EQ(voronoiGrains(box({0, 0}, {2, 1}), 50, 3).size(), 50);
}

TEST(Voronoi, SameSeedSameGrains) {
  EXPECT_EQ(voronoiGrains(kAngle, 50, 9, 2), voronoiGrains(kAngle, 50, 9, 2));
  EXPECT_NE(voronoiGrains(kAngle, 50, 9), voronoiGrains(kAngle, 50, 10));
}

TEST(Voronoi, RoundsMakeGrainsEven) {
  const Loop plate = box({0, 0}, {2, 2});
  // Areas of random cells differ by 0.53 of their mean (Gilbert 1962: 0.529).
  EXPECT_NEAR(spread(voronoiGrains(plate, 400, 2)), .53, .06);
  EXPECT_LT(spread(voronoiGrains(plate, 400, 2, 5)), .3);
  const auto even = voronoiGrains(kAngle, 100, 2, 20);
  expectGrains(kAngle, even);
  EXPECT_LT(spread(even), .15);
}

TEST(Voronoi, ShortSidesShrinkToPoints) {
  for (const Loop& outline : {box({0, 0}, {2, 2}), kAngle, circle({1, 1}, 1, 40)}) {
    const auto all = voronoiGrains(outline, 150, 6);
    constexpr double kShortest = .02;  // of grains that are .16 across
    const auto grains = withoutShortSides(all, outline, kShortest);
    expectGrains(outline, grains);
    double least = INFINITY, leastBefore = INFINITY;
    const auto shortestOf = [](const std::vector<Loop>& loops) {
      double shortest = INFINITY;
      for (const Loop& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          shortest = std::min(shortest, norm(loop[(i + 1) % loop.size()] - loop[i]));
      return shortest;
    };
    least = shortestOf(grains), leastBefore = shortestOf(all);
    EXPECT_GE(least, kShortest);
    EXPECT_LT(leastBefore, kShortest / 10);
    EXPECT_GE(grains.size() + 5, all.size());
  }
  EXPECT_EQ(withoutShortSides(voronoiGrains(kAngle, 30, 1), kAngle, 1e-12),
            voronoiGrains(kAngle, 30, 1));
  EXPECT_THROW((void)withoutShortSides(voronoiGrains(kAngle, 30, 1), kAngle, 1.5), InputError);
}

TEST(Voronoi, ClockwiseOutlinesAndImpossibleOnes) {
  Loop turned = kAngle;
  std::reverse(turned.begin(), turned.end());
  expectGrains(kAngle, voronoiGrains(turned, 20, 1));
  EXPECT_THROW((void)voronoiGrains({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 5, 1), InputError);
  EXPECT_THROW((void)voronoiGrains({{0, 0}, {1, 1}}, 5, 1), InputError);
  EXPECT_THROW((void)voronoiGrains({{0, 0}, {1, 1}, {1 + 1e-9, 1}}, 5, 1), InputError);
  EXPECT_THROW((void)voronoiGrains({{0, 0}, {1e308, 0}, {1e308, 1e308}}, 5, 1), InputError);
  const Vec2 far{1e17, 1e17};  // where numbers are 16 apart
  EXPECT_THROW((void)voronoiGrains({far, far + Vec2{64, 0}, far + Vec2{0, 64}}, 50, 1), InputError);
  const Loop tiny{{0, 0}, {1e-100, 0}, {1e-100, 1e-100}};
  EXPECT_EQ(voronoiGrains(tiny, 10, 1).size(), 10);
}

}  // namespace
}  // namespace yadefrag
