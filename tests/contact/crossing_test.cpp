// Where a moving point goes through the line of a moving piece: against steps in time.

#include "contact/crossing.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <random>

namespace yadefrag::test {
namespace {

double gapOf(const PointAndPiece& at) {
  const Vec2 along = at.piece.end - at.piece.begin;
  return cross(at.point - at.piece.begin, along) / norm(along);
}

Vec2 between(Vec2 a, Vec2 b, double time) { return a + time * (b - a); }

PointAndPiece between(const PointAndPiece& a, const PointAndPiece& b, double time) {
  return {between(a.point, b.point, time),
          {between(a.piece.begin, b.piece.begin, time), between(a.piece.end, b.piece.end, time)}};
}

class Moves {
 public:
  Vec2 any(double size) {
    std::uniform_real_distribution<double> chance(-size, size);
    return {chance(random_), chance(random_)};
  }
  /// A piece from near (0, 0) to near (1, 0), and a point near it.
  PointAndPiece state() { return {Vec2{.5, 0} + any(.5), {any(.2), Vec2{1, 0} + any(.2)}}; }

 private:
  std::mt19937 random_{7};
};

/// The lines' lengths vary, so the depth at the time found is `depth` only where they do not.
TEST(Crossing, SameAsManySmallSteps) {
  Moves moves;
  int crossings = 0, behind = 0, returns = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const PointAndPiece before = moves.state(), now = moves.state();
    // The first fall of gap × length below 0 that lasts to the end.
    constexpr int kSteps = 400;
    double time = -1;
    for (int i = 0; i < kSteps; ++i) {
      const double from = gapOf(between(before, now, double(i) / kSteps));
      const double to = gapOf(between(before, now, double(i + 1) / kSteps));
      if (from >= 0 && to < 0) time = (i + .5) / kSteps;
    }
    const auto found = crossing(before, now, 0);
    if (gapOf(now) >= 0) {
      EXPECT_FALSE(found);
      ++returns;
      continue;
    }
    // Two roots within a step in time, or one at an end, cannot be resolved by steps.
    if (time < 0 && found) {
      const double nearest = std::min(found->time, 1 - found->time);
      EXPECT_TRUE(nearest < 1. / kSteps ||
                  std::abs(gapOf(between(before, now, found->time - 1. / kSteps))) < .01)
          << trial;
      continue;
    }
    ASSERT_EQ(found.has_value(), time >= 0) << trial;
    behind += !found;
    if (!found) continue;
    ++crossings;
    EXPECT_NEAR(found->time, time, 1. / kSteps);
    const PointAndPiece then = between(before, now, found->time);
    EXPECT_NEAR(gapOf(then), 0, 1e-12);
    const Vec2 along = then.piece.end - then.piece.begin;
    EXPECT_NEAR(found->xi, dot(then.point - then.piece.begin, along) / dot(along, along), 1e-9);
  }
  EXPECT_GT(crossings, 2000);
  EXPECT_GT(behind, 2000);
  EXPECT_GT(returns, 2000);
}

const PieceEnds kPiece{{0, 0}, {-1, 0}};  // its void side is above

TEST(Crossing, TheDepthCountsAsBefore) {
  constexpr double kDepth = 1e-3;
  const auto at = [](Vec2 point) { return PointAndPiece{point, kPiece}; };
  // What is left a little inside, and sinks on.
  const auto sinks = crossing(at({-.5, -.9e-3}), at({-.5, -2e-3}), kDepth);
  ASSERT_TRUE(sinks);
  EXPECT_NEAR(sinks->time, .1 / 1.1, 1e-12);
  // It does not get as deep: the end of the step decides where it is.
  const auto slides = crossing(at({-.5, 0}), at({-.8, -.5e-3}), kDepth);
  ASSERT_TRUE(slides);
  EXPECT_EQ(slides->time, 1);
  EXPECT_NEAR(slides->xi, .8, 1e-12);
  // Deeper from the start, and what comes up from there, has not come in.
  EXPECT_FALSE(crossing(at({-.5, -1.1e-3}), at({-.5, -2e-3}), kDepth));
  EXPECT_FALSE(crossing(at({-.5, -1.1e-3}), at({-.5, -.5e-3}), kDepth));
  // Outside at the end.
  EXPECT_FALSE(crossing(at({-.5, -.5e-3}), at({-.5, 0}), kDepth));
}

/// A common velocity changes nothing: only relative motion counts.
TEST(Crossing, SameInAnyFrame) {
  Moves moves;
  for (int trial = 0; trial < 1000; ++trial) {
    const PointAndPiece before = moves.state(), now = moves.state();
    const Vec2 by = moves.any(1);
    const PointAndPiece moved{now.point + by, {now.piece.begin + by, now.piece.end + by}};
    const auto a = crossing(before, now, 1e-4), b = crossing(before, moved, 1e-4);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_NEAR(a->time, b->time, 1e-9);
    EXPECT_NEAR(a->xi, b->xi, 1e-9);
  }
}

/// A piece whose ends meet has no line; nothing is found, and nothing is divided by 0.
TEST(Crossing, APieceWithoutLength) {
  const PieceEnds point{{0, 0}, {0, 0}};
  EXPECT_FALSE(crossing({{0, 1}, point}, {{0, -1}, point}, 1e-4));
}

}  // namespace
}  // namespace yadefrag::test
