// Entry, one point at a time: the cases of figs. 8 and 9 of the paper, and those that the side on
// which a point was does not decide.

#include "contact/path_rules.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <tuple>

#include "contact/point_against_body.hpp"

namespace yadefrag::test {
namespace {

using Masters = std::vector<std::size_t>;

// Piece 0 is the square's lower face, 1 the right one, 2 the upper, 3 the left.
const std::vector<Vec2> kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
// 0 the base, 1 the right face, 2 the left one.
const std::vector<Vec2> kWedge{{-.3, 0}, {.3, 0}, {0, 1}};

TEST(PathRules, ActiveIsWhatCrossesAPiece) {
  PointAgainstBody point(kSquare, {}, {0, -1}, {.5, 1.2});
  EXPECT_EQ(point.masters({.5, 1.1}), Masters{});
  const std::vector<Active> actives = point.step({.55, .97}, {.55, 1});
  ASSERT_EQ(actives.size(), 1U);
  EXPECT_EQ(actives[0].pair, (SlaveMaster{point.tip(), point.body() + 2}));
  EXPECT_NEAR(actives[0].foot.gap, -.03, 1e-15);
  EXPECT_NEAR(actives[0].foot.xi, .45, 1e-15);
  EXPECT_EQ(actives[0].foot.normal, (Vec2{0, 1}));
  EXPECT_EQ(point.masters({.55, .999}, {.55, .99}), Masters{2}) << "left inside, it stays active";
  EXPECT_EQ(point.masters({.6, .98}, {.6, 1}), Masters{2});
  EXPECT_EQ(point.masters({.6, 1.1}), Masters{}) << "it leaves";
}

TEST(PathRules, InsideFromTheStartIsNotActive) {
  PointAgainstBody point(kSquare, {}, {0, -1}, {.5, .95});
  EXPECT_EQ(point.masters({.5, .94}), Masters{});
  EXPECT_EQ(point.masters({.5, .9999}), Masters{}) << "it comes from behind";
  EXPECT_EQ(point.masters({.5, 1.01}), Masters{});
  EXPECT_EQ(point.masters({.5, .99}), Masters{2});
}

/// What others push a little in, or rounding places there, is not lost to the face.
TEST(PathRules, LeftALittleInside) {
  for (const double left : {1e-15, 1e-6, .9 * PointAgainstBody::kDepth}) {
    PointAgainstBody point(kSquare, {}, {0, -1}, {.5, 1.001});
    EXPECT_TRUE(point.step({.5, 1.0001}, {.5, 1 - left}).empty()) << "predicted before the face";
    EXPECT_EQ(point.masters({.5, .999}), Masters{2}) << left;
  }
  PointAgainstBody deep(kSquare, {}, {0, -1}, {.5, 1.001});
  EXPECT_TRUE(deep.step({.5, 1.0001}, {.5, .999}).empty());
  EXPECT_EQ(deep.masters({.5, .998}), Masters{}) << "it may come from anywhere";
}

/// B of fig. 8: for many steps behind the upper face's line, beside the body. It is none of that
/// face's concern, even where it comes in nearer to it than to the face it comes through.
TEST(PathRules, BehindALineBesideTheBody) {
  PointAgainstBody point(kSquare, {}, {-1, -1}, {1.3, .8});
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(point.masters({1.3 - .009 * i, .8 + .2 * std::sin(i)}), Masters{}) << i;
  EXPECT_EQ(point.masters({.9, .99}), Masters{1});
}

/// A splinter of 3°: none of its two sides opposes the face that it pricks, but its tip does.
TEST(PathRules, NeedlePricksAFace) {
  for (const double tilt : {0., .02, -.02, .3, -.3, 1., -1.}) {
    const Vec2 direction{std::sin(tilt), -std::cos(tilt)};
    PointAgainstBody point(kSquare, {}, direction, Vec2{.5, 1.01} - .05 * direction);
    EXPECT_EQ(point.masters(Vec2{.5, .99} + .01 * direction), Masters{2}) << tilt;
  }
}

/// From beside the body into it, all the time behind the upper face's line: the lateral face is the
/// one that is crossed.
TEST(PathRules, PastTheEndOfAFace) {
  PointAgainstBody point(kSquare, {}, {1, 0}, {-.1, .9});
  EXPECT_EQ(point.masters({.05, .9}), Masters{3});
  PointAgainstBody over(kSquare, {}, {0, -1}, {-.1, 1.1});
  EXPECT_EQ(over.masters({-.1, .9}), Masters{}) << "beside the body";
  PointAgainstBody end(kSquare, {}, {0, -1}, {1, 1.1});
  EXPECT_EQ(end.masters({1, .95}), Masters{2}) << "the end belongs to the piece";
}

/// Through a plate that is thinner than the step's motion, and out at the other side.
TEST(PathRules, ThroughAThinBody) {
  PointAgainstBody point({{0, .99}, {1, .99}, {1, 1}, {0, 1}}, {}, {0, -1}, {.5, 1.05});
  EXPECT_EQ(point.masters({.5, .95}), Masters{2});
}

/// Over the corner of a body and past it within one step: it has gone through.
TEST(PathRules, ThroughACorner) {
  PointAgainstBody point(kSquare, {}, {-1, -1}, {.98, 1.01});
  EXPECT_EQ(point.masters({1.01, .98}), Masters{2});
  PointAgainstBody past(kSquare, {}, {-1, -1}, {1, 1.02});
  EXPECT_EQ(past.masters({1.02, .98}), Masters{}) << "its path misses the body";
}

struct Fig9 {
  Vec2 from, to;
  std::size_t master;
};

class SharpMaster : public testing::TestWithParam<Fig9> {};

/// What came from the left is held by the left face, however deep it is and however near the other.
TEST_P(SharpMaster, TheFaceThatWasCrossed) {
  const auto [from, to, master] = GetParam();
  PointAgainstBody point(kWedge, {}, to - from, from);
  const std::vector<Active> actives = point.step(to);
  ASSERT_EQ(actives.size(), 1U);
  EXPECT_EQ(actives[0].pair.master, point.body() + master);
  EXPECT_GT(dot(actives[0].foot.normal, from - to), 0) << "against its motion, not with it";
}

INSTANTIATE_TEST_SUITE_P(Figure9, SharpMaster,
                         testing::Values(Fig9{{-.3, .6}, {.05, .6}, 2},
                                         Fig9{{-.3, .6}, {-.1, .6}, 2},
                                         Fig9{{.3, .6}, {-.05, .6}, 1}, Fig9{{.3, .6}, {.1, .6}, 1},
                                         Fig9{{0, 1.1}, {.01, .8}, 1},   // C
                                         Fig9{{0, 1.1}, {-.01, .8}, 2},  // C
                                         Fig9{{.02, 1.1}, {.01, .8}, 1},
                                         Fig9{{-.02, 1.1}, {-.01, .8}, 2}));

// A notch in the upper face, its bottom at the origin. 2 falls into it, 3 rises from it.
std::vector<Vec2> notch(double depth) {
  return {{-1, -1}, {1, -1}, {1, depth}, {0, 0}, {-1, depth}};
}

class BottomOfANotch : public testing::TestWithParam<double> {};

/// Straight into the corner, exactly or nearly: a path that crosses no piece but its end. Where
/// neither piece has a foot below the point, both hold it: together a correction to the corner's
/// node.
TEST_P(BottomOfANotch, WithoutAFootBothMastersHoldTheSlave) {
  for (const double x : {0., 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, 1e-3, -1e-3}) {
    PointAgainstBody straight(notch(GetParam()), {}, {0, -1}, {x, .05});
    EXPECT_EQ(straight.masters({x, -.02}), (Masters{2, 3})) << x;
    PointAgainstBody oblique(notch(GetParam()), {}, {0, -1}, {0, .05});
    EXPECT_EQ(oblique.masters({x, -.02}), (Masters{2, 3})) << x;
  }
}

/// Beside the corner there is a foot, on one of the two only.
TEST_P(BottomOfANotch, WithAFootThatMasterAloneHoldsIt) {
  const double depth = GetParam();
  PointAgainstBody right(notch(depth), {}, {0, -1}, {.3, .31 * depth});
  EXPECT_EQ(right.masters({.3, .29 * depth}), Masters{2});
  PointAgainstBody left(notch(depth), {}, {0, -1}, {-.3, .31 * depth});
  EXPECT_EQ(left.masters({-.3, .29 * depth}), Masters{3});
}

/// One that was under the notch all the time is no concern of its pieces.
TEST_P(BottomOfANotch, InsideFromTheStart) {
  PointAgainstBody point(notch(GetParam()), {}, {0, -1}, {0, -.02});
  EXPECT_EQ(point.masters({0, -.03}), Masters{});
}

INSTANTIATE_TEST_SUITE_P(Notches, BottomOfANotch, testing::Values(.2, 1., 3.));

/// Below the corner of a narrow notch a point can be behind one of the faces only, past its end.
TEST(PathRules, NotchNarrowerThanARightAngle) {
  for (const double x : {.01, .03}) {
    PointAgainstBody right(notch(3), {}, {0, -1}, {0, .05});
    EXPECT_EQ(right.masters({x, -.02}), Masters{2});
    PointAgainstBody left(notch(3), {}, {0, -1}, {0, .05});
    EXPECT_EQ(left.masters({-x, -.02}), Masters{3});
    PointAgainstBody inside(notch(3), {}, {0, -1}, {x, -.04});
    EXPECT_EQ(inside.masters({x, -.02}), Masters{});
  }
}

/// Off the end of a face: released behind the corner, it is not pulled back.
TEST(PathRules, SlidesOffACorner) {
  PointAgainstBody point(kSquare, {}, {0, -1}, {.05, 1});
  for (int i = 1; i < 10; ++i) {
    const double x = .05 - .01 * i;
    EXPECT_EQ(point.masters({x, .999}, {x, x >= 0 ? 1 : .999}),
              x >= -1e-9 ? Masters{2} : Masters{});
  }
}

class SlidingOverAJoint : public testing::TestWithParam<std::tuple<double, double, int>> {};

/// `rise` is that of the boundary left of the joint at (0, 0): a notch if positive. `rounding` (m)
/// is how much the correction leaves the point above or below. A point that is pressed on the upper
/// face slides over a joint of two pieces: some piece holds it in every step, wherever rounding
/// leaves it.
TEST_P(SlidingOverAJoint, KeepsContact) {
  const auto [rise, rounding, way] = GetParam();
  // The boundary falls, runs level or rises left of the joint, and mirrored for the way back.
  const std::vector<Vec2> leftTurned{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {-1, rise}};
  const std::vector<Vec2> rightTurned{{-1, -1}, {1, -1}, {1, rise}, {0, 0}, {-1, 0}};
  const auto height = [&, rise = rise, way = way](double x) {
    return way * x < 0 ? std::abs(x) * rise : 0;
  };
  const double begin = .1 * way;
  PointAgainstBody point(way > 0 ? leftTurned : rightTurned, {}, {0, -1}, {begin, 0});
  for (int i = 1; i < 200; ++i) {
    const double x = begin - way * i * .2 / 199;
    const double on = height(x);
    const std::vector<Active> actives = point.step({x, on - 1e-3}, {x, on + rounding});
    ASSERT_GE(actives.size(), 1U) << "x = " << x;
    for (const Active& active : actives) EXPECT_LT(active.foot.gap, 0);
    // Both at once only in a notch.
    if (rise <= 0) {
      EXPECT_EQ(actives.size(), 1U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Joints, SlidingOverAJoint,
                         testing::Combine(testing::Values(0., -1e-6, -.01, -.2, 1e-6, .01, .2),
                                          testing::Values(0., 1e-12, -1e-12, -.9e-4),
                                          testing::Values(1, -1)));

}  // namespace
}  // namespace yadefrag::test
