#include "fracture/separation.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <numbers>

namespace yadefrag {
namespace {

const BrittleMaterial kEven{.tensileStrength = 1e6};
const BrittleMaterial kShearProof{.tensileStrength = 1e6, .shearFactor = 2};
constexpr double kFriction = .4;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The same stress seen in axes turned by −angle: R σ Rᵀ.
std::array<double, 3> turned(const std::array<double, 3>& s, double angle) {
  const double c = std::cos(angle);
  const double n = std::sin(angle);
  return {c * c * s[0] + n * n * s[1] - 2 * c * n * s[2],
          n * n * s[0] + c * c * s[1] + 2 * c * n * s[2],
          c * n * (s[0] - s[1]) + (c * c - n * n) * s[2]};
}

TEST(Separation, TractionOfTheAxesAndTheDiagonal) {
  const std::array<double, 3> stress{3, -5, 2};
  const Traction x = tractionOn(stress, {1, 0});
  EXPECT_EQ(x.normal, 3);
  EXPECT_EQ(x.shear, 2);
  const Traction y = tractionOn(stress, {0, 1});
  EXPECT_EQ(y.normal, -5);
  EXPECT_EQ(y.shear, -2);  // along −x
  const Traction diagonal = tractionOn(stress, direction(std::numbers::pi / 4));
  EXPECT_NEAR(diagonal.normal, (3 - 5) / 2. + 2, 1e-14);
  EXPECT_NEAR(diagonal.shear, (-5 - 3) / 2., 1e-14);
}

TEST(Separation, BothSidesOfALineHaveTheSameTraction) {
  const std::array<double, 3> stress{3, -5, 2};
  for (double angle = 0; angle < 3; angle += .1) {
    const Traction one = tractionOn(stress, direction(angle));
    const Traction other = tractionOn(stress, -direction(angle));
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.shear, other.shear);
  }
}

TEST(Separation, DoesNotDependOnTheAxes) {
  const std::array<double, 3> stress{3, -5, 2};
  for (double angle = 0; angle < 6.3; angle += .1)
    for (double normal = 0; normal < 6.3; normal += .7) {
      const Traction here = tractionOn(stress, direction(normal));
      const Traction there = tractionOn(turned(stress, angle), direction(normal + angle));
      EXPECT_NEAR(there.normal, here.normal, 1e-13);
      EXPECT_NEAR(there.shear, here.shear, 1e-13);
      EXPECT_NEAR(effectiveTraction(there.normal, there.shear, kShearProof, kFriction),
                  effectiveTraction(here.normal, here.shear, kShearProof, kFriction), 1e-13);
    }
}

TEST(Separation, UniformTensionActsOnEveryLineAlike) {
  for (double angle = 0; angle < 6.3; angle += .1) {
    const Traction t = tractionOn({7, 7, 0}, direction(angle));
    EXPECT_NEAR(effectiveTraction(t.normal, t.shear, kShearProof, kFriction), 7, 1e-14);
  }
}

TEST(Separation, UniaxialTensionActsMostOnLinesAcrossIt) {
  double most = 0;
  double at = 0;
  for (double angle = -1.5; angle < 1.55; angle += .01) {
    const Traction t = tractionOn({4, 0, 0}, direction(angle));
    const double effective = effectiveTraction(t.normal, t.shear, kShearProof, kFriction);
    if (effective > most) most = effective, at = angle;
  }
  EXPECT_NEAR(at, 0, 1e-9);
  EXPECT_NEAR(most, 4, 1e-14);
}

TEST(Separation, EffectiveTractionIsTheFormula) {
  EXPECT_EQ(effectiveTraction(5, 0, kShearProof, kFriction), 5);
  EXPECT_EQ(effectiveTraction(3, 4, kEven, kFriction), 5);
  EXPECT_EQ(effectiveTraction(3, -8, kShearProof, kFriction), 5);
  EXPECT_DOUBLE_EQ(effectiveTraction(-5, 4, kEven, kFriction), 2);
  EXPECT_DOUBLE_EQ(effectiveTraction(-5, -4, kShearProof, kFriction), 1);
  EXPECT_EQ(effectiveTraction(-10, 4, kEven, kFriction), 0);   // just sticks
  EXPECT_EQ(effectiveTraction(-100, 4, kEven, kFriction), 0);  // sticks
  EXPECT_EQ(effectiveTraction(-5, 4, kEven, 0), 4);
}

TEST(Separation, IsContinuousAndGrowsWithTheNormalTraction) {
  for (const double shear : {-3., 0., 1e-6, 3.}) {
    const double none = effectiveTraction(0, shear, kShearProof, kFriction);
    EXPECT_EQ(none, std::abs(shear) / 2);
    EXPECT_NEAR(effectiveTraction(-1e-12, shear, kShearProof, kFriction), none, 1e-12);
    EXPECT_NEAR(effectiveTraction(1e-12, shear, kShearProof, kFriction), none, 1e-12);
    double before = 0;
    for (double normal = -20; normal < 20; normal += .125) {
      const double now = effectiveTraction(normal, shear, kShearProof, kFriction);
      EXPECT_GE(now, before);
      EXPECT_LE(now - before, .125 + 1e-12);  // never steeper than 1 (friction/β < 1)
      before = now;
    }
  }
}

}  // namespace
}  // namespace yadefrag
