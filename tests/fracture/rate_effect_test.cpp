#include "mesh/rate_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fracture/separation.hpp"

namespace yadefrag::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The sentence that these points are refused with; empty if they are not.
std::string saidOf(std::vector<RatePoint> points) {
  const bool isValid = RateEffect::isValid(points);
  try {
    const RateEffect made(std::move(points));
    EXPECT_TRUE(isValid);
    return {};
  } catch (const InputError& error) {
    EXPECT_FALSE(isValid);
    return error.what();
  }
}

// By hand, from the two formulas: 10^(0.018 n) at 10^(n − 6) /s; 0.0062 · 10^(n/3) above 10 /s.
TEST(RateEffect, ConcreteByTheModelCode) {
  const RateEffect effect = rateEffectNamed("ceb-fip-2010");
  EXPECT_TRUE(effect.isOn());
  for (const double rate : {-5., 0., 1e-9, 1e-6}) EXPECT_EQ(effect.factor(rate), 1) << rate;
  EXPECT_NEAR(effect.factor(1e-5), 1.0423, 1e-4);
  EXPECT_NEAR(effect.factor(1e-3), 1.1324, 1e-4);
  EXPECT_NEAR(effect.factor(1), 1.2823, 1e-4);
  EXPECT_NEAR(effect.factor(10), 1.3366, 1e-4);
  // Between the places where both formulas are met: at most by their jump of 0.0006 higher.
  EXPECT_NEAR(effect.factor(30) / 1.9264, 1, 6e-4);
  EXPECT_NEAR(effect.factor(100) / 2.8778, 1, 6e-4);
  EXPECT_NEAR(effect.factor(300), 4.1504, 1e-4);
  EXPECT_EQ(effect.factor(1e6), effect.factor(300));
  EXPECT_EQ(effect.largest(), effect.factor(300));
  EXPECT_EQ(effect.least(), 1);
}

TEST(RateEffect, NoneIsOne) {
  for (const RateEffect& none : {RateEffect(), rateEffectNamed("none")}) {
    EXPECT_FALSE(none.isOn());
    for (const double rate : {0., 1., 1e9}) EXPECT_EQ(none.factor(rate), 1);
    EXPECT_EQ(none.largest(), 1);
    EXPECT_EQ(none.least(), 1);
  }
}

// √(1·4) = 2 in the middle of the logarithms; the nearest point's outside.
TEST(RateEffect, PointsAreJoinedByPowersOfTheRate) {
  const RateEffect effect({{1, 1}, {100, 4}, {1e4, 2}});
  EXPECT_EQ(effect.factor(.01), 1);
  EXPECT_EQ(effect.factor(1), 1);
  EXPECT_NEAR(effect.factor(10), 2, 1e-14);
  EXPECT_EQ(effect.factor(100), 4);
  EXPECT_NEAR(effect.factor(1000), std::sqrt(8.), 1e-14);
  EXPECT_EQ(effect.factor(1e4), 2);
  EXPECT_EQ(effect.factor(1e7), 2);
  EXPECT_EQ(effect.factor(-1), 1);
  EXPECT_EQ(effect.largest(), 4);
  EXPECT_EQ(RateEffect({{1, 1.5}, {2, 3}}).factor(0), 1.5);
}

TEST(RateEffect, RefusesPointsThatAreNoFactors) {
  EXPECT_EQ(saidOf({}), "");
  EXPECT_EQ(saidOf({{1, 1}, {2, 1000}}), "");
  EXPECT_EQ(saidOf({{1, 2}}), "rateEffect has one point; it must have at least two.");
  EXPECT_EQ(saidOf({{1, 1}, {1, 2}}),
            "rateEffect has the strain rate 1 1/s after 1 1/s; rates must increase.");
  EXPECT_EQ(saidOf({{2, 1}, {1, 2}}),
            "rateEffect has the strain rate 1 1/s after 2 1/s; rates must increase.");
  EXPECT_EQ(saidOf({{-1, 1}, {1, 2}}),
            "rateEffect has the strain rate -1 1/s; rates must be positive and finite.");
  EXPECT_EQ(saidOf({{0, 1}, {1, 2}}),
            "rateEffect has the strain rate 0 1/s; rates must be positive and finite.");
  EXPECT_EQ(saidOf({{1, 1}, {2, .9}}),
            "rateEffect has the factor 0.9; factors must be from 1, the strength of a slow test, "
            "to 1000.");
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(saidOf({{1, 1}, {bad, 2}}), "");
    EXPECT_NE(saidOf({{bad, 1}, {2, 2}}), "");
    EXPECT_NE(saidOf({{1, 1}, {2, bad}}), "");
    EXPECT_NE(saidOf({{1, bad}, {2, 2}}), "");
  }
  try {
    (void)rateEffectNamed("ceb");
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "rateEffect is 'ceb'; it must be one of 'none', 'ceb-fip-2010', or points (strain "
              "rate in 1/s, factor of the strength).");
  }
}

// The direction is that of the largest principal stress, not that of the largest rate.
TEST(RateEffect, TheRateIsThatOfTheDirectionOfTheStress) {
  EXPECT_DOUBLE_EQ(strainRateAlong({5, 1, 0}, {2, -3, 7}), 2);
  EXPECT_DOUBLE_EQ(strainRateAlong({-5, -1, 0}, {2, -3, 7}), -3);
  EXPECT_DOUBLE_EQ(strainRateAlong({0, 0, 4}, {2, -3, 7}), -.5 + 7);
  EXPECT_DOUBLE_EQ(strainRateAlong({0, 0, -4}, {2, -3, 7}), -.5 - 7);
  EXPECT_DOUBLE_EQ(strainRateAlong({3, 3, 0}, {2, -3, 7}), -.5);
  for (double angle = .1; angle < 3; angle += .3) {  // of a bar of any direction
    const double c = std::cos(angle), s = std::sin(angle);
    const std::array<double, 3> stress{6 * c * c, 6 * s * s, 6 * c * s};
    EXPECT_NEAR(strainRateAlong(stress, {4 * c * c - s * s, 4 * s * s - c * c, 5 * c * s}), 4,
                1e-14);
  }
}

}  // namespace
}  // namespace yadefrag::test
