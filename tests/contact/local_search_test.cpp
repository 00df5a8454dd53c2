// The outside-inside criterion (§5.1, fig. 8), the direction of the correction (§5.2, fig. 9) and
// its two exceptions, one point at a time.

#include "contact/local_search.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "contact/chase.hpp"

namespace yadefrag::test {
namespace {

using Masters = std::vector<std::size_t>;

// Piece 0 is the square's lower face, 1 the right one, 2 the upper, 3 the left.
const std::vector<Vec2> kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
// 0 the base, 1 the right face, 2 the left one.
const std::vector<Vec2> kWedge{{-.3, 0}, {.3, 0}, {0, 1}};

TEST(LocalSearch, ActiveIsWhatWasOutsideAndIsInside) {
  Chase chase(kSquare, {}, {0, -1}, {.5, 1.2});
  EXPECT_EQ(chase.masters({.5, 1.1}), Masters{});
  EXPECT_EQ(chase.masters({.5, 1.0001}), Masters{});
  const std::vector<Active> actives = chase.step({.55, .97}, {.55, 1});
  ASSERT_EQ(actives.size(), 1U);
  EXPECT_EQ(actives[0].pair, (SlaveMaster{chase.tip(), chase.body() + 2}));
  EXPECT_NEAR(actives[0].foot.gap, -.03, 1e-15);
  EXPECT_NEAR(actives[0].foot.xi, .45, 1e-15);
  EXPECT_EQ(actives[0].foot.normal, (Vec2{0, 1}));
  EXPECT_EQ(chase.masters({.55, 1.1}), Masters{}) << "it leaves";
  EXPECT_EQ(chase.masters({.55, .99}), Masters{2}) << "and comes back";
}

/// B of fig. 8: for many steps behind the upper face's line, beside the body. It is none of that
/// face's concern, even where it comes in nearer to it than to the face it comes through.
TEST(LocalSearch, BehindALineBesideTheBody) {
  Chase chase(kSquare, {}, {-1, -1}, {1.3, .8});
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(chase.masters({1.3 - .009 * i, .8 + .2 * std::sin(i)}), Masters{}) << i;
  EXPECT_EQ(chase.masters({.9, .99}), Masters{1});
}

TEST(LocalSearch, InsideFromTheStartIsNotActive) {
  Chase chase(kSquare, {}, {0, -1}, {.5, .9});
  EXPECT_EQ(chase.masters({.5, .8}), Masters{});
  EXPECT_EQ(chase.masters({.5, .99}), Masters{});
  EXPECT_EQ(chase.masters({.5, 1.01}), Masters{});
  EXPECT_EQ(chase.masters({.5, .99}), Masters{2}) << "once out, it is kept out";
}

/// What others push a little in, or rounding places there, is not lost to the face.
TEST(LocalSearch, LeftALittleInside) {
  for (const double left : {1e-6, 1e-15}) {
    Chase chase(kSquare, {}, {0, -1}, {.5, 1.001});
    chase.left = 2e-6;
    EXPECT_TRUE(chase.step({.5, 1.0001}, {.5, 1 - left}).empty()) << "predicted before the face";
    EXPECT_EQ(chase.masters({.5, .999}), Masters{2}) << left;
  }
  Chase deep(kSquare, {}, {0, -1}, {.5, 1.001});
  deep.left = 2e-6;
  EXPECT_TRUE(deep.step({.5, 1.0001}, {.5, .999}).empty());
  EXPECT_EQ(deep.masters({.5, .998}), Masters{})
      << "as deep as it moves: it may come from anywhere";
}

TEST(LocalSearch, PastTheEndsOfAPiece) {
  Chase chase(kSquare, {}, {0, -1}, {-.1, 1.1});
  EXPECT_EQ(chase.masters({-.1, .9}), Masters{}) << "beside the body";
  Chase end(kSquare, {}, {0, -1}, {1, 1.1});
  EXPECT_EQ(end.masters({1, .95}), Masters{2}) << "the end belongs to the piece";
}

struct Fig9 {
  Vec2 from, to;
  std::size_t master;
};

class SharpMaster : public testing::TestWithParam<Fig9> {};

/// A came from the left and B from the right, however deep and however near to the other face; C
/// was before both and goes back through the nearer one.
TEST_P(SharpMaster, CorrectsTowardsWhereTheSlaveWas) {
  const auto [from, to, master] = GetParam();
  Chase chase(kWedge, {}, to - from, from);
  const std::vector<Active> actives = chase.step(to);
  ASSERT_EQ(actives.size(), 1U);
  EXPECT_EQ(actives[0].pair.master, chase.body() + master);
  EXPECT_GT(dot(actives[0].foot.normal, from - to), 0) << "against its motion, not with it";
}

INSTANTIATE_TEST_SUITE_P(Figure9, SharpMaster,
                         testing::Values(Fig9{{-.3, .6}, {.05, .6}, 2},  // A, deep
                                         Fig9{{-.3, .6}, {-.1, .6}, 2},  // A
                                         Fig9{{.3, .6}, {-.05, .6}, 1},  // B, deep
                                         Fig9{{.3, .6}, {.1, .6}, 1},    // B
                                         Fig9{{0, 1.1}, {.01, .8}, 1},   // C, nearer to the right
                                         Fig9{{0, 1.1}, {-.01, .8}, 2},  // C, nearer to the left
                                         Fig9{{.02, 1.1}, {-.03, .8}, 2},
                                         Fig9{{-.02, 1.1}, {.03, .8}, 1}));

/// A splinter of 3°: none of its two sides opposes the face that it pricks, but its tip does.
TEST(LocalSearch, NeedlePricksAFace) {
  for (const double tilt : {0., .02, -.02, .3, -.3, 1., -1.}) {
    const Vec2 direction{std::sin(tilt), -std::cos(tilt)};
    Chase chase(kSquare, {}, direction, Vec2{.5, 1.01} - .05 * direction);
    EXPECT_EQ(chase.masters(Vec2{.5, .99} + .01 * direction), Masters{2}) << tilt;
  }
}

/// The lateral faces of blocks that lie on one another take no part.
TEST(LocalSearch, FacesThatDoNotOpposeAreNoMasters) {
  for (const double aside : {0., 1e-12, -1e-12, 1e-6, -1e-6}) {
    SurfaceScene scene;
    const EntryId low = scene.addBody(kSquare);
    scene.addBody({{aside, 1}, {1 + aside, 1}, {1 + aside, 2}, {aside, 2}});
    Candidates candidates;
    std::vector<SlaveMaster> pairs = nearPairs(scene, false, .2);
    replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
    for (std::size_t n = 4; n < 8; ++n) scene.at[n].y -= .01;
    LocalSearch search;
    std::vector<Active> actives;
    search.scan(candidates, scene.surfaces, scene.at, kUnlimited, 1);
    search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, actives);
    ASSERT_FALSE(actives.empty());
    for (const Active& active : actives) {
      const bool down = active.pair.slave.value >= 4;
      EXPECT_EQ(active.pair.master, low + (down ? 2 : 4)) << aside;
    }
  }
}

/// A corner that grazes a corner: behind the upper face's line already, it comes in through the
/// left one, which its own left side does not oppose. Then the upper one has to take it.
TEST(LocalSearch, CornerThatGrazesACorner) {
  SurfaceScene scene;
  const EntryId low = scene.addBody(kSquare);
  const EntryId corner = scene.addBody({{-1e-3, .999}, {1, .999}, {1, 2}, {-1e-3, 2}});
  Candidates candidates;
  std::vector<SlaveMaster> pairs{{corner, low + 2}, {corner, low + 3}};
  replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
  EXPECT_EQ(candidates.outside, (std::vector<std::uint8_t>{0, 1}));
  scene.at[corner.value] = {1e-3, .9985};
  LocalSearch search;
  std::vector<Active> actives;
  search.scan(candidates, scene.surfaces, scene.at, .01, 1);
  search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, actives);
  ASSERT_EQ(actives.size(), 1U);
  EXPECT_EQ(actives[0].pair.master, low + 2);
  search.settle(candidates, scene.surfaces, scene.at, pairsOf(actives));
  EXPECT_EQ(candidates.outside, (std::vector<std::uint8_t>{1, 0})) << "it stays the upper one's";
}

class PassedTip : public testing::TestWithParam<std::pair<double, bool>> {};

/// Tips of 60° that have passed each other, sides along sides: no face of one opposes the face that
/// its tip is at, however the sides are turned to each other; but a corner that stands askew on a
/// face is held by it.
TEST_P(PassedTip, IsNoMatterOfTheFaceThatItGoesAlong) {
  const auto [turn, held] = GetParam();
  SurfaceScene scene;
  const EntryId left = scene.addBody({{0, 0}, {1, 0}, {.5, .87}});
  // From its tip the sides go at `turn` and `turn` + 60°, against the lower face of the left one.
  const auto at = [tip = Vec2{.05, -1e-3}](double angle) {
    return tip + Vec2{std::cos(angle), std::sin(angle)};
  };
  constexpr double kThird = std::numbers::pi / 3;
  const EntryId tip = scene.addBody({{.05, -1e-3}, at(turn), at(turn + kThird)});
  Candidates candidates;
  std::vector<SlaveMaster> pairs{{tip, left}};
  replaceCandidates(candidates, pairs, scene.surfaces, scene.at);
  EXPECT_EQ(candidates.outside, std::vector<std::uint8_t>{1});
  for (std::size_t n = 3; n < 6; ++n) scene.at[n].y += 2e-3;
  LocalSearch search;
  std::vector<Active> actives;
  search.scan(candidates, scene.surfaces, scene.at, .01, 1);
  search.findActives(candidates, scene.surfaces, scene.at, kUnlimited, actives);
  EXPECT_EQ(actives.size(), held ? 1U : 0U);
}

// Below the face the sides go at angles from -180° to 0.
INSTANTIATE_TEST_SUITE_P(
    Turns, PassedTip,
    testing::Values(std::pair{-2 * std::numbers::pi / 3, true}, std::pair{-std::numbers::pi, true},
                    std::pair{-std::numbers::pi / 3, true}, std::pair{-std::numbers::pi - .3, true},
                    std::pair{-std::numbers::pi / 3 + .3, true},
                    std::pair{-std::numbers::pi - .4, false},
                    std::pair{-std::numbers::pi / 3 + .4, false},
                    std::pair{2 * std::numbers::pi / 3, false}, std::pair{0., false}));

// A notch in the upper face, its bottom at the origin. 2 falls into it, 3 rises from it.
std::vector<Vec2> notch(double depth) {
  return {{-1, -1}, {1, -1}, {1, depth}, {0, 0}, {-1, depth}};
}

class BottomOfANotch : public testing::TestWithParam<double> {};

/// Where neither piece has a foot below the point, both hold it: together a correction to the
/// corner's node.
TEST_P(BottomOfANotch, WithoutAFootBothMastersHoldTheSlave) {
  const double depth = GetParam();
  for (const double x : {0., 1e-9, -1e-9, 1e-3, -1e-3}) {
    Chase chase(notch(depth), {}, {0, -1}, {0, .05});
    const std::vector<Active> actives = chase.step({x, -.02});
    ASSERT_EQ(actives.size(), 2U) << x;
    EXPECT_EQ(actives[0].pair.master, chase.body() + 2);
    EXPECT_EQ(actives[1].pair.master, chase.body() + 3);
  }
}

/// Beside the corner there is a foot, on one of the two only.
TEST_P(BottomOfANotch, WithAFootThatMasterAloneHoldsIt) {
  const double depth = GetParam();
  Chase right(notch(depth), {}, {0, -1}, {.3, .31 * depth});
  EXPECT_EQ(right.masters({.3, .29 * depth}), Masters{2});
  Chase left(notch(depth), {}, {0, -1}, {-.3, .31 * depth});
  EXPECT_EQ(left.masters({-.3, .29 * depth}), Masters{3});
}

/// One that was under the notch all the time is no concern of its pieces.
TEST_P(BottomOfANotch, InsideFromTheStart) {
  Chase chase(notch(GetParam()), {}, {0, -1}, {0, -.02});
  EXPECT_EQ(chase.masters({0, -.03}), Masters{});
}

INSTANTIATE_TEST_SUITE_P(Notches, BottomOfANotch, testing::Values(.2, 1., 3.));

/// Below the corner of a narrow notch a point can be behind one of the faces only, past its end.
TEST(LocalSearch, NotchNarrowerThanARightAngle) {
  for (const double x : {.01, .03}) {
    Chase right(notch(3), {}, {0, -1}, {0, .05});
    EXPECT_EQ(right.masters({x, -.02}), Masters{2});
    Chase left(notch(3), {}, {0, -1}, {0, .05});
    EXPECT_EQ(left.masters({-x, -.02}), Masters{3});
    Chase inside(notch(3), {}, {0, -1}, {x, -.04});
    EXPECT_EQ(inside.masters({x, -.02}), Masters{});
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
  Chase chase(way > 0 ? leftTurned : rightTurned, {}, {0, -1}, {begin, 0});
  for (int i = 1; i < 200; ++i) {
    const double x = begin - way * i * .2 / 199;
    const double on = height(x);
    const std::vector<Active> actives = chase.step({x, on - 1e-3}, {x, on + rounding});
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
                                          testing::Values(0., 1e-17, -1e-17, 1e-12, -1e-12),
                                          testing::Values(1, -1)));

/// Over a joint too far from a step's motion: released behind the corner, it is not pulled back.
TEST(LocalSearch, SlidesOffACorner) {
  Chase chase(kSquare, {}, {0, -1}, {.05, 1});
  for (int i = 1; i < 10; ++i) {
    const double x = .05 - .01 * i;
    EXPECT_EQ(chase.masters({x, .999}, {x, x >= 0 ? 1 : .999}),
              x >= -1e-9 ? Masters{2} : Masters{});
  }
}

}  // namespace
}  // namespace yadefrag::test
