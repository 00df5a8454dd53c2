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

/// The law at a known opening.
double lawAt(double opening, double largest) {
  if (opening >= largest) return envelope(kStrength, kCritical, opening);
  return envelope(kStrength, kCritical, largest) * opening / largest;
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

TEST(CohesiveLaw, EffectiveOpeningLeavesOutClosing) {
  EXPECT_EQ(effectiveOpening(3, 4, 1), 5);
  EXPECT_EQ(effectiveOpening(3, -2, 2), 5);
  EXPECT_EQ(effectiveOpening(-3, 4, .5), 2);
}

TEST(CohesiveTraction, EveryEndIsOnTheLaw) {
  for (const double c : kCompliances)
    for (const double part : kLargest)
      for (double trial = 0; trial < 3; trial += 1. / 128) {
        const double k = c / kStiffness;
        const double largest = part * kCritical;
        const double t = traction(largest, trial * kCritical, k);
        const double opening = trial * kCritical - k * t;
        // The opening's rounding is that of δ*; the envelope turns it into traction.
        const double rounding = 4e-16 * kStrength * (1 + 4 * trial) / (1 - c);
        ASSERT_GE(t, 0);
        ASSERT_LE(t, envelope(kStrength, kCritical, largest));
        ASSERT_GE(opening, -rounding / kStiffness);
        if (opening > largest + rounding / kStiffness) {
          ASSERT_NEAR(t, lawAt(opening, largest), rounding) << c << ' ' << part << ' ' << trial;
        } else if (largest > 0) {  // by its ratio, for the line may be steep
          ASSERT_NEAR(t * largest, envelope(kStrength, kCritical, largest) * opening,
                      rounding * kCritical)
              << c << ' ' << part << ' ' << trial;
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
  const double beyond = traction(0, 1.01 * k * kStrength, k);
  EXPECT_LT(beyond, kStrength);
  EXPECT_GT(1.01 * k * kStrength - k * beyond, 0);
}

TEST(CohesiveTraction, IsTheLimitOfEverSmallerOpenings) {
  const double k = .3 / kStiffness;
  for (double trial = 0; trial < 1.5; trial += .01)
    EXPECT_NEAR(traction(1e-9 * kCritical, trial * kCritical, k), traction(0, trial * kCritical, k),
                1e-8 * kStrength);
}

TEST(CohesiveTraction, IsContinuousAndTheOpeningGrowsWithTheTrial) {
  const double step = 1. / 4096;
  for (const double c : kCompliances)
    for (const double part : kLargest) {
      if (c == 0 && part < .1) continue;  // a prescribed opening on an (all but) upright line
      const double k = c / kStiffness;
      const double largest = part * kCritical;
      const double held = envelope(kStrength, kCritical, largest);
      // Slopes dT/dδ*: T(δmax)/(δmax + kT(δmax)) up, kStiffness/(1 − c) down.
      const double steepest =
          std::max(held > 0 ? held / (largest + k * held) : 0, kStiffness / (1 - c));
      double before = 0;
      double opened = 0;
      bool falls = false;
      for (double trial = 0; trial < 3; trial += step) {
        const double t = traction(largest, trial * kCritical, k);
        const double opening = trial * kCritical - k * t;
        ASSERT_LE(std::abs(t - before), steepest * step * kCritical * (1 + 1e-9));
        ASSERT_GE(opening, opened - 1e-15 * kCritical / (1 - c));
        if (t < before) falls = true;
        ASSERT_TRUE(!falls || t <= before);  // one rise, one fall
        before = t;
        opened = opening;
      }
    }
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
  EXPECT_EQ(traction(.5 * kCritical, kCritical, k), 0);
}

TEST(CohesiveTraction, SnapsWhereTheEnvelopeIsSteeperThanInertia) {
  for (const double c : {1., 1.5, 100.})
    for (const double part : {0., .3, .9}) {
      const double k = c / kStiffness;
      const double largest = part * kCritical;
      const double held = envelope(kStrength, kCritical, largest);
      const double last = largest + k * held;
      EXPECT_DOUBLE_EQ(traction(largest, last, k), held);
      EXPECT_NEAR(traction(largest, last / 2, k), held / 2, 1e-15 * kStrength);
      EXPECT_EQ(traction(largest, last * (1 + 1e-12), k), 0);
      EXPECT_GE(last * (1 + 1e-12), kCritical);  // so it is on the law
    }
}

/// Follows openings from 0, in `steps` even steps each, kinks hit exactly, and checks at each that
/// the work done so far is what the law says is spent or recoverable.
struct Driven {
  double compliance;
  double largest = 0;
  double opening = 0;
  double held = kStrength;  // an edge begins to open at its strength
  double work = 0;

  void to(double target) {
    const double t = traction(largest, target + compliance * lawAt(target, largest), compliance);
    const double reached = target + compliance * lawAt(target, largest) - compliance * t;
    EXPECT_NEAR(reached, target, 1e-14 * kCritical / (1 - compliance * kStiffness));
    EXPECT_NEAR(t, lawAt(target, largest), 1e-14 * kStrength / (1 - compliance * kStiffness));
    work += (held + t) / 2 * (reached - opening);
    held = t;
    opening = reached;
    largest = std::max(largest, reached);
    EXPECT_NEAR(work,
                spentEnergy(kStrength, kCritical, largest) +
                    recoverableEnergy(kStrength, kCritical, largest, opening),
                1e-12 * kEnergy);
  }
};

TEST(CohesiveTraction, ADrivenOpeningSpendsWhatTheLawSays) {
  const std::vector<double> turns{0, .3, 0, .3, .6, .2, .6, .8, .8, .1, .8, 1, .5, 1.5, 0, 2};
  for (const double c : kCompliances) {
    Driven edge{.compliance = c / kStiffness};
    for (std::size_t i = 1; i < turns.size(); ++i) {
      const int steps = 37;
      for (int s = 1; s <= steps; ++s)
        edge.to((turns[i - 1] + (turns[i] - turns[i - 1]) * s / steps) * kCritical);
      EXPECT_NEAR(edge.opening, turns[i] * kCritical, 1e-12 * kCritical);
    }
    EXPECT_EQ(edge.held, 0);
    EXPECT_NEAR(edge.work, kEnergy, 1e-12 * kEnergy);
  }
}

/// A mass that tears an edge open, stepped as the solver does: x* first, then T.
TEST(CohesiveTraction, AMassPulledOffLosesTheFractureEnergy) {
  const double mass = 1;  // kg per m² of edge
  const double speed = std::sqrt(4 * kEnergy / mass);
  const double dt = kCritical / speed / 1000;
  double x = 0;
  double v = speed;
  double largest = 0;
  while (largest < kCritical) {
    const double trial = x + dt * v;
    const double t = traction(largest, trial, dt * dt / mass);
    x = trial - dt * dt / mass * t;
    v -= dt / mass * t;
    largest = std::max(largest, x);
  }
  EXPECT_NEAR(mass * v * v / 2, 2 * kEnergy - kEnergy, .002 * kEnergy);
}

}  // namespace
}  // namespace yadefrag
