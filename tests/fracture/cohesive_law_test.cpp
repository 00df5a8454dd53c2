#include "fracture/cohesive_law.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace yadefrag {
namespace {

constexpr double kStrength = 300e6;                          // Pa
constexpr double kEnergy = 100;                              // J/m²
constexpr double kCritical = 2 * kEnergy / kStrength;        // m
constexpr double kStiffness = kStrength / kCritical;         // Pa/m, of the envelope
constexpr double kCompliances[] = {0, .01, .3, .9, .999};    // of 1/kStiffness
constexpr double kLargest[] = {0, 1e-9, .1, .5, .99, 1, 2};  // of kCritical

double traction(double largest, double trial, double compliance) {
  return cohesiveTraction(kStrength, kCritical, largest, trial, compliance);
}

TEST(CohesiveLaw, EnvelopeFallsFromTheStrengthToNothing) {
  EXPECT_EQ(envelope(kStrength, kCritical, 0), kStrength);
  EXPECT_DOUBLE_EQ(envelope(kStrength, kCritical, kCritical / 4), .75 * kStrength);
  EXPECT_EQ(envelope(kStrength, kCritical, kCritical), 0);
  EXPECT_EQ(envelope(kStrength, kCritical, 2 * kCritical), 0);
  EXPECT_EQ(envelope(kStrength, 0, 0), 0);
}

TEST(CohesiveLaw, SpentAndRecoverableEnergyAreTheAreaBelowTheEnvelope) {
  EXPECT_EQ(spentEnergy(kStrength, kCritical, 0), 0);
  EXPECT_DOUBLE_EQ(spentEnergy(kStrength, kCritical, kCritical), kEnergy);
  EXPECT_DOUBLE_EQ(spentEnergy(kStrength, kCritical, 3 * kCritical), kEnergy);
  EXPECT_EQ(recoverableEnergy(kStrength, kCritical, 0, 0), 0);
  EXPECT_EQ(recoverableEnergy(kStrength, kCritical, kCritical, kCritical), 0);
  for (double part = .125; part <= 1; part += .125) {
    const double d = part * kCritical;
    const double area = (kStrength + envelope(kStrength, kCritical, d)) / 2 * d;
    EXPECT_NEAR(
        spentEnergy(kStrength, kCritical, d) + recoverableEnergy(kStrength, kCritical, d, d), area,
        1e-13 * kEnergy);
    EXPECT_NEAR(recoverableEnergy(kStrength, kCritical, d, d / 2),
                recoverableEnergy(kStrength, kCritical, d, d) / 4, 1e-15 * kEnergy);
  }
}

/// A motion that unloads ends on the line to the origin; one that opens further meets the envelope
/// at the largest opening so far.
TEST(CohesiveTraction, UnloadsOnTheLineAndOpensAlongTheEnvelope) {
  for (const double c : kCompliances)
    for (const double part : kLargest) {
      const double k = c / kStiffness, largest = part * kCritical;
      const double most = envelope(kStrength, kCritical, largest);
      for (double trial = 1. / 64; trial < 3; trial += 1. / 64) {
        const double t = traction(largest, trial * kCritical, k);
        const double opening = trial * kCritical - k * t;
        ASSERT_LE(t, most);
        if (opening > largest + 1e-12 * kCritical) {
          ASSERT_EQ(t, most);
        } else if (largest > 0) {
          ASSERT_NEAR(t, most * opening / largest, 1e-5 * kStrength);  // rounding of tiny openings
        }
      }
    }
}

TEST(CohesiveTraction, HoldsANewEdgeClosedUpToItsStrength) {
  const double k = .3 / kStiffness;
  EXPECT_EQ(traction(0, 0, k), 0);
  for (const double load : {.1, .5, .999}) {
    const double trial = load * k * kStrength;
    EXPECT_DOUBLE_EQ(traction(0, trial, k), load * kStrength);
    EXPECT_NEAR(trial - k * traction(0, trial, k), 0, 1e-15 * kCritical);
  }
  EXPECT_DOUBLE_EQ(traction(0, k * kStrength, k), kStrength);
  EXPECT_EQ(traction(0, 1.01 * k * kStrength, k), kStrength);  // it opens
}

TEST(CohesiveTraction, IsTheLimitOfEverSmallerOpenings) {
  const double k = .3 / kStiffness;
  for (double trial = 0; trial < 1.5; trial += .01)
    EXPECT_NEAR(traction(1e-9 * kCritical, trial * kCritical, k), traction(0, trial * kCritical, k),
                1e-8 * kStrength);
}

TEST(CohesiveTraction, ClosedOrBrokenHoldsNothing) {
  const double k = .3 / kStiffness;
  EXPECT_EQ(traction(.5 * kCritical, 0, k), 0);
  EXPECT_EQ(traction(0, 0, 0), 0);
  for (const double trial : {1e-9, .5, 1., 2.}) {
    EXPECT_EQ(traction(kCritical, trial * kCritical, k), 0);
    EXPECT_EQ(traction(5 * kCritical, trial * kCritical, k), 0);
    EXPECT_EQ(cohesiveTraction(kStrength, 0, 0, trial * kCritical, k), 0);  // Gc = 0
  }
}

}  // namespace
}  // namespace yadefrag
