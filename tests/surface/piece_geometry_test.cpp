#include "surface/piece_geometry.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <numbers>
#include <random>

#include "surface_checks.hpp"

namespace yadefrag {
namespace {

EntryId entry(std::size_t e) { return EntryId(e); }

std::vector<Vec2> bumpyLoop(std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> radius(.5, 1.5);
  std::vector<Vec2> x;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(count);
    x.push_back(radius(random) * Vec2{std::cos(angle), std::sin(angle)});
  }
  return x;
}

TEST(PieceGeometry, BoxHoldsThePieceAndEndsAreItsEnds) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 300; ++k) {
    const std::size_t n = 3 + random() % 8;
    std::vector<std::uint8_t> smooth(n);
    for (auto& flag : smooth) flag = random() % 2;
    const auto x = bumpyLoop(random, n);
    const ContactSurfaces s = oneLoop(smooth);
    const PieceGeometry g(s, x);
    for (std::size_t e = 0; e < s.entries(); ++e) {
      const Box box = g.box(entry(e));
      const PieceRange range = pieceRange(s.piece[e]);
      EXPECT_NEAR(norm(g.point(entry(e), range.begin) - g.ends(entry(e)).begin), 0, 1e-15);
      EXPECT_NEAR(norm(g.point(entry(e), range.end) - g.ends(entry(e)).end), 0, 1e-15);
      double length = 0;
      Vec2 last = g.ends(entry(e)).begin;
      for (int i = 1; i <= 1000; ++i) {
        const Vec2 p = g.point(entry(e), range.begin + (range.end - range.begin) * i / 1000);
        length += norm(p - last);
        last = p;
        ASSERT_TRUE(p.x >= box.min[0] - 1e-14 && p.x <= box.max[0] + 1e-14);
        ASSERT_TRUE(p.y >= box.min[1] - 1e-14 && p.y <= box.max[1] + 1e-14);
      }
      EXPECT_NEAR(g.length(entry(e)), length, 1e-3 * length);
      EXPECT_EQ(box.min[2], 0);
      EXPECT_EQ(box.max[2], 0);
    }
  }
}

TEST(PieceGeometry, SmoothCircleIsNearlyRoundAndItsNormalsPointOutward) {
  std::vector<Vec2> x;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    x.push_back({std::cos(angle), std::sin(angle)});
  }
  const ContactSurfaces s = oneLoop(std::vector<std::uint8_t>(40, 1));
  const PieceGeometry g(s, x);
  double perimeter = 0;
  for (std::size_t e = 0; e < s.entries(); ++e) {
    perimeter += g.length(entry(e));
    const Vec2 p = g.slave(entry(e));
    EXPECT_NEAR(norm(g.normal(entry(e), 0) - (1 / norm(p)) * p), 0, 1e-12);
    const Foot foot = g.foot(entry(e), {0, 0});
    EXPECT_LT(foot.gap, -.99);
    EXPECT_TRUE(g.mayPenetrate(entry(e), {0, 0}));
    EXPECT_FALSE(g.mayPenetrate(entry(e), 1.2 * p));
  }
  EXPECT_NEAR(perimeter, 2 * std::numbers::pi, .01 * 2 * std::numbers::pi);
}

TEST(PieceGeometry, NormalsOfASquareWithOneSmoothCorner) {
  const std::vector<Vec2> x = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const ContactSurfaces s = oneLoop({0, 0, 1, 0});
  const PieceGeometry g(s, x);  // segment, first half, arc, second half, segment
  const Vec2 expected[] = {{0, -1}, {1, 0}, {1, 0}, {0, 1}, {-1, 0}};
  for (std::size_t e = 0; e < 5; ++e)
    EXPECT_NEAR(norm(g.normal(entry(e), g.range(entry(e)).begin) - expected[e]), 0, 1e-15) << e;

  const Foot first = g.foot(entry(1), {1.5, .25});
  EXPECT_DOUBLE_EQ(first.xi, .25);
  EXPECT_DOUBLE_EQ(first.gap, .5);
  EXPECT_TRUE(first.inside);
  EXPECT_FALSE(g.foot(entry(1), {1.5, .75}).inside);
  const Foot second = g.foot(entry(3), {.25, .9});
  EXPECT_DOUBLE_EQ(second.xi, .75);
  EXPECT_NEAR(second.gap, -.1, 1e-15);
  EXPECT_TRUE(second.inside);
  EXPECT_FALSE(g.foot(entry(3), {.75, .9}).inside);
}

TEST(PieceGeometry, QuickTestIsNecessaryForEveryKindOfPiece) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> even(-2, 2);
  for (int k = 0; k < 500; ++k) {
    std::vector<std::uint8_t> smooth(6);
    for (auto& flag : smooth) flag = random() % 2;
    const auto x = bumpyLoop(random, 6);
    const ContactSurfaces s = oneLoop(smooth);
    const PieceGeometry g(s, x);
    for (std::size_t e = 0; e < s.entries(); ++e) {
      const Vec2 p{even(random), even(random)};
      const Foot foot = g.foot(entry(e), p);
      if (foot.inside && foot.gap < 0) {
        EXPECT_TRUE(g.mayPenetrate(entry(e), p));
      }
    }
  }
}

}  // namespace
}  // namespace yadefrag
