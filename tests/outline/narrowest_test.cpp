#include "outline/narrowest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace yadefrag {
namespace {

using Loops = std::vector<std::vector<Vec2>>;

/// The same by all pairs of a corner and a side.
NarrowPlace byAllPairs(const Loops& loops) {
  NarrowPlace best{std::numeric_limits<double>::infinity(), 0};
  std::size_t corner = 0;
  for (const auto& own : loops)
    for (const Vec2 p : own) {
      for (const auto& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Vec2 a = loop[k];
          const Vec2 b = loop[(k + 1) % loop.size()];
          if (p == a || p == b) continue;
          const double part = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0., 1.);
          const double distance = norm(p - a - part * (b - a));
          if (distance < best.distance) best = {distance, corner};
        }
      ++corner;
    }
  return best;
}

std::vector<Vec2> star(std::mt19937& random, Vec2 centre, double radius, int count) {
  std::uniform_real_distribution<double> factor(.3, 1);
  std::vector<Vec2> loop;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * k / count;
    loop.push_back(centre + radius * factor(random) * Vec2{std::cos(angle), std::sin(angle)});
  }
  return loop;
}

TEST(Narrowest, AsByAllPairs) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const double unit = std::pow(10., round % 7 - 3);
    Loops loops{star(random, {0, 0}, 10 * unit, 3 + round % 40)};
    for (int hole = 0; hole < round % 5; ++hole)
      loops.push_back(star(random, unit * Vec2{20. * hole, 1. * hole}, 9.99 * unit, 3 + round % 7));
    const NarrowPlace wanted = byAllPairs(loops);
    const NarrowPlace found = narrowestPlace(loops);
    EXPECT_NEAR(found.distance, wanted.distance, 1e-13 * unit);
    EXPECT_EQ(found.corner, wanted.corner);
  }
}

TEST(Narrowest, LongObliqueSlits) {
  // Slits of width .5 and the length 100, at 45°; the one at corner 8 is .1 away from the next one.
  Loops loops;
  const Vec2 along{std::sqrt(.5), std::sqrt(.5)};
  const Vec2 across{-along.y, along.x};
  for (int i = 0; i < 20; ++i) {
    const Vec2 start = (i < 2 ? i : i - .4) * across;
    loops.push_back(
        {start, start + 100 * along, start + 100 * along + .5 * across, start + .5 * across});
  }
  const NarrowPlace found = narrowestPlace(loops);
  EXPECT_NEAR(found.distance, .1, 1e-12);
  EXPECT_EQ(found.corner, byAllPairs(loops).corner);
}

TEST(Narrowest, InfiniteWithoutAPair) {
  EXPECT_TRUE(std::isinf(narrowestPlace({{{0, 0}, {1, 0}}}).distance));
}

}  // namespace
}  // namespace yadefrag
