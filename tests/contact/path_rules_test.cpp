// Entry by the path, one point at a time: the cases of figs. 8 and 9 of the paper, and those that
// flags cannot decide.

#include "contact/path_rules.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <tuple>

#include "contact/chase.hpp"

namespace yadefrag::test {
namespace {

using Masters = std::vector<std::size_t>;

// Piece 0 is the square's lower face, 1 the right one, 2 the upper, 3 the left.
const std::vector<Vec2> kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
// 0 the base, 1 the right face, 2 the left one.
const std::vector<Vec2> kWedge{{-.3, 0}, {.3, 0}, {0, 1}};

Chase chaseByPath(const std::vector<Vec2>& points, Vec2 direction, Vec2 from) {
  return {points, {}, direction, from, Entry::kPath};
}

TEST(PathRules, ActiveIsWhatCrossesAPiece) {
  Chase chase = chaseByPath(kSquare, {0, -1}, {.5, 1.2});
  EXPECT_EQ(chase.masters({.5, 1.1}), Masters{});
  EXPECT_EQ(chase.masters({.55, .97}, {.55, 1}), Masters{2});
  EXPECT_EQ(chase.masters({.55, .999}, {.55, .99}), Masters{2}) << "left inside, it stays active";
  EXPECT_EQ(chase.masters({.6, .98}, {.6, 1}), Masters{2});
  EXPECT_EQ(chase.masters({.6, 1.1}), Masters{}) << "it leaves";
}

TEST(PathRules, InsideFromTheStartIsNotActive) {
  Chase chase = chaseByPath(kSquare, {0, -1}, {.5, .95});
  EXPECT_EQ(chase.masters({.5, .94}), Masters{});
  EXPECT_EQ(chase.masters({.5, .9999}), Masters{}) << "it comes from behind";
  EXPECT_EQ(chase.masters({.5, 1.01}), Masters{});
  EXPECT_EQ(chase.masters({.5, .99}), Masters{2});
}

/// From beside the body into it, with the upper face's flag at `inside` all the time: the lateral
/// face is the one that is crossed.
TEST(PathRules, PastTheEndOfAFace) {
  Chase chase = chaseByPath(kSquare, {1, 0}, {-.1, .9});
  EXPECT_EQ(chase.masters({.05, .9}), Masters{3});
  Chase over = chaseByPath(kSquare, {0, -1}, {-.1, 1.1});
  EXPECT_EQ(over.masters({-.1, .9}), Masters{}) << "beside the body";
  Chase end = chaseByPath(kSquare, {0, -1}, {1, 1.1});
  EXPECT_EQ(end.masters({1, .95}), Masters{2}) << "the end belongs to the piece";
}

/// Through a plate that is thinner than the step's motion, and out at the other side.
TEST(PathRules, ThroughAThinBody) {
  Chase chase = chaseByPath({{0, .99}, {1, .99}, {1, 1}, {0, 1}}, {0, -1}, {.5, 1.05});
  EXPECT_EQ(chase.masters({.5, .95}), Masters{2});
}

/// Over the corner of a body and past it within one step: it has gone through.
TEST(PathRules, ThroughACorner) {
  Chase chase = chaseByPath(kSquare, {-1, -1}, {.98, 1.01});
  EXPECT_EQ(chase.masters({1.01, .98}), Masters{2});
  Chase past = chaseByPath(kSquare, {-1, -1}, {1, 1.02});
  EXPECT_EQ(past.masters({1.02, .98}), Masters{}) << "its path misses the body";
}

struct Fig9 {
  Vec2 from, to;
  std::size_t master;
};

class SharpMasterByPath : public testing::TestWithParam<Fig9> {};

/// What came from the left is held by the left face, however deep it is and however near the other.
TEST_P(SharpMasterByPath, TheFaceThatWasCrossed) {
  const auto [from, to, master] = GetParam();
  Chase chase = chaseByPath(kWedge, to - from, from);
  EXPECT_EQ(chase.masters(to), Masters{master});
}

INSTANTIATE_TEST_SUITE_P(Figure9, SharpMasterByPath,
                         testing::Values(Fig9{{-.3, .6}, {.05, .6}, 2},
                                         Fig9{{-.3, .6}, {-.1, .6}, 2},
                                         Fig9{{.3, .6}, {-.05, .6}, 1}, Fig9{{.3, .6}, {.1, .6}, 1},
                                         Fig9{{.02, 1.1}, {.01, .8}, 1},
                                         Fig9{{-.02, 1.1}, {-.01, .8}, 2}));

// A notch in the upper face, its bottom at the origin. 2 falls into it, 3 rises from it.
std::vector<Vec2> notch(double depth) {
  return {{-1, -1}, {1, -1}, {1, depth}, {0, 0}, {-1, depth}};
}

class NotchByPath : public testing::TestWithParam<double> {};

/// Straight into the corner, exactly or nearly: a path that crosses no piece but its end.
TEST_P(NotchByPath, IntoTheBottom) {
  for (const double x : {0., 1e-12, -1e-12, 1e-9, -1e-9, 1e-6}) {
    Chase chase = chaseByPath(notch(GetParam()), {0, -1}, {x, .05});
    EXPECT_FALSE(chase.masters({x, -.02}).empty()) << x;
  }
}

TEST_P(NotchByPath, OneThatWasUnderIt) {
  Chase chase = chaseByPath(notch(GetParam()), {0, -1}, {0, -.02});
  EXPECT_EQ(chase.masters({0, -.03}), Masters{});
}

INSTANTIATE_TEST_SUITE_P(Notches, NotchByPath, testing::Values(.2, 1., 3.));

class SlidingByPath : public testing::TestWithParam<std::tuple<double, double, int>> {};

/// As of flags (local_search_test.cpp): over a joint of two pieces some piece holds the point in
/// every step, wherever rounding leaves it; here without any rule for what slides past an end.
TEST_P(SlidingByPath, KeepsContact) {
  const auto [rise, rounding, way] = GetParam();
  const std::vector<Vec2> leftTurned{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {-1, rise}};
  const std::vector<Vec2> rightTurned{{-1, -1}, {1, -1}, {1, rise}, {0, 0}, {-1, 0}};
  const auto height = [&, rise = rise, way = way](double x) {
    return way * x < 0 ? std::abs(x) * rise : 0;
  };
  const double begin = .1 * way;
  Chase chase = chaseByPath(way > 0 ? leftTurned : rightTurned, {0, -1}, {begin, 0});
  for (int i = 1; i < 200; ++i) {
    const double x = begin - way * i * .2 / 199;
    const double on = height(x);
    const std::vector<Active> actives = chase.step({x, on - 1e-3}, {x, on + rounding});
    ASSERT_GE(actives.size(), 1U) << "x = " << x;
    for (const Active& active : actives) EXPECT_LT(active.foot.gap, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Joints, SlidingByPath,
                         testing::Combine(testing::Values(0., -1e-6, -.01, -.2, 1e-6, .01, .2),
                                          testing::Values(0., 1e-12, -1e-12, -.9e-4),
                                          testing::Values(1, -1)));

}  // namespace
}  // namespace yadefrag::test
