// The cohesive law, and its softening curves.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/two_triangles.hpp"
#include "mesh/softening_curve.hpp"

namespace yadefrag::test {
namespace {

constexpr double kStiffness = kStrength / kCritical;         // Pa/m, of the envelope
constexpr double kCompliances[] = {0, .01, .3, .9, .999};    // of 1/kStiffness
constexpr double kLargest[] = {0, 1e-9, .1, .5, .99, 1, 2};  // of kCritical

const SofteningCurve kLine;
const TensionLaw kLaw{kLine, kStrength, kCritical};

CohesiveHold holdAt(double largest, AcrossAlong compliance, double beta = 1, double kappa = 1,
                    double friction = 0) {
  return {envelope(kLaw, largest), largest, beta, beta * beta / kappa, friction, compliance};
}

double traction(double largest, double trial, double compliance) {
  return faceTractions(holdAt(largest, {compliance, compliance}), {trial, 0}, 0).normal;
}

/// A motion that unloads ends on the line to the origin; one that opens further meets the envelope
/// at the largest opening so far.
TEST(CohesiveTraction, UnloadsOnTheLineAndOpensAlongTheEnvelope) {
  for (const double c : kCompliances)
    for (const double part : kLargest) {
      const double k = c / kStiffness, largest = part * kCritical;
      const double most = envelope(kLaw, largest);
      for (double trial = 1. / 64; trial < 3; trial += 1. / 64) {
        const double t = traction(largest, trial * kCritical, k);
        const double opening = trial * kCritical - k * t;
        ASSERT_LE(t, most * (1 + 1e-14));
        if (opening > largest + 1e-12 * kCritical) {
          ASSERT_NEAR(t, most, 1e-11 * kStrength);
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
  EXPECT_DOUBLE_EQ(traction(0, 1.01 * k * kStrength, k), kStrength);  // it opens
  // The limit of ever smaller openings.
  for (double trial = 0; trial < 1.5 * kCritical; trial += .01 * kCritical)
    EXPECT_NEAR(traction(1e-9 * kCritical, trial, k), traction(0, trial, k), 1e-8 * kStrength);
}

// The tractions do not jump when an edge opens, in no direction: they continue, and the opening
// that follows has the law's direction for just these tractions.
TEST(CohesiveTraction, GoesOnFromWhatHeldTheEdgeInBothDirections) {
  for (const double beta : {.5, 1., 3.})
    for (const double kappa : {.5, 1., 4.})
      for (const double mix : {.01, .3, .7, .99}) {
        const AcrossAlong k{.3 / kStiffness, .2 / kStiffness};
        const CohesiveHold hold = holdAt(0, k, beta, kappa);
        const double normal = mix * kStrength;
        const double shear = -beta * std::sqrt(1 - mix * mix) * kStrength;
        for (const double more : {-1e-9, 1e-9, 1e-3}) {
          const double part = 1 + more;
          const AcrossAlong trial{part * k.normal * normal, part * k.shear * shear};
          const FaceTractions t = faceTractions(hold, trial, 0);
          // What is too much goes into the opening, and the tractions' direction turns by a
          // multiple of it, 10 at these mixes.
          EXPECT_NEAR(t.normal, normal, 10 * std::abs(more) * std::max(beta, 1.) * kStrength);
          EXPECT_NEAR(t.shear, shear, 10 * std::abs(more) * std::max(beta, 1.) * kStrength);
          const double open = trial.normal - k.normal * t.normal;
          const double slip = trial.shear - k.shear * t.shear;
          const double delta = effectiveOpening({open, slip}, beta, beta * beta / kappa);
          if (more < 0) {
            EXPECT_NEAR(delta, 0, 1e-15 * kCritical);
          } else if (more > 1e-6) {
            EXPECT_NEAR(t.normal, kStrength * open / delta, 1e-9 * kStrength);
            EXPECT_NEAR(t.shear, kStrength * beta * beta / kappa * slip / delta, 1e-9 * kStrength);
          }
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
    const CohesiveHold none{envelope({kLine, kStrength, 0}, 0), 0, 1, 1, 0, {k, k}};
    EXPECT_EQ(faceTractions(none, {trial * kCritical, 0}, 0).normal, 0);  // Gc = 0
  }
}

// By its own opening where both ends are alike, by the mean where they differ by δc: without a
// jump, and never back while either end opens on.
TEST(CohesiveLaw, AnEdgeOpensAsAWholeWhenItsEndsDiffer) {
  EXPECT_EQ(countedOpening(.4, .4, 1), .4);
  EXPECT_EQ(countedOpening(0, 1, 1), .5);
  EXPECT_EQ(countedOpening(1, 0, 1), .5);
  EXPECT_EQ(countedOpening(0, 2, 1), 1);
  EXPECT_NEAR(countedOpening(.5, .75, 1), .5 + .25 / 32, 1e-15);
  for (double own = 0; own < 2; own += .1)
    for (double other = 0; other < 2; other += .1) {
      const double counted = countedOpening(own, other, 1);
      EXPECT_NEAR(counted + countedOpening(other, own, 1), own + other, 1e-12);
      EXPECT_LE(counted, countedOpening(own, other + .01, 1) + 1e-12);
    }
}

// --- softening curve

constexpr double kUnit = kEnergy / kStrength;  // m

TensionLaw lawOf(const SofteningCurve& curve) {
  return {curve, kStrength, curve.criticalOpening(kStrength, kEnergy)};
}

/// (J/m²) By the trapezoid rule, from 0 to `end`.
double areaBelow(const TensionLaw& law, double end) {
  constexpr int kParts = 200000;
  double sum = 0;
  for (int i = 0; i < kParts; ++i)
    sum += envelope(law, end * i / kParts) + envelope(law, end * (i + 1) / kParts);
  return sum / 2 * end / kParts;
}

TEST(SofteningCurve, EachHasTheAreaGcAndBeginsWithTheStrength) {
  for (const auto& [name, curve] : softeningCurves()) {
    const TensionLaw law = lawOf(curve);
    EXPECT_EQ(envelope(law, 0), kStrength) << name;
    for (const double part : {1., 2.})
      EXPECT_EQ(envelope(law, part * law.criticalOpening), 0) << name;
    EXPECT_NEAR(areaBelow(law, law.criticalOpening), kEnergy, 1e-8 * kEnergy) << name;
    EXPECT_NEAR(spentEnergy(law, law.criticalOpening), kEnergy, 1e-12 * kEnergy) << name;
    EXPECT_NEAR(spentEnergy(law, 3 * law.criticalOpening), kEnergy, 1e-12 * kEnergy) << name;
  }
}

// What is spent never decreases: unloading to the origin cannot return more than is stored.
TEST(SofteningCurve, SpentAndRecoverableEnergyAreTheAreaBelow) {
  for (const auto& [name, curve] : softeningCurves()) {
    const TensionLaw law = lawOf(curve);
    double last = 0;
    for (double part = .05; part < 1; part += .05) {
      const double opening = part * law.criticalOpening, spent = spentEnergy(law, opening);
      // By closing ½Tδ is recovered.
      EXPECT_NEAR(spent + envelope(law, opening) * opening / 2, areaBelow(law, opening),
                  1e-8 * kEnergy)
          << name << ' ' << part;
      EXPECT_GE(spent, last - 1e-12 * kEnergy) << name << ' ' << part;
      last = spent;
    }
  }
}

TEST(SofteningCurve, TheLineHasTheBitsOfItsFormula) {
  const SofteningCurve line;
  for (const double strength : {3e6, 1.1e7, 300e6, 1.7e9})
    for (const double energy : {.3, 7., 100., 1234.5}) {
      const double critical = line.criticalOpening(strength, energy);
      EXPECT_EQ(critical, 2 * energy / strength);
      for (double part = 0; part < 1; part += .07) {
        const double opening = part * critical;
        EXPECT_EQ(envelope({line, strength, critical}, opening),
                  strength * (critical - opening) / critical);
        EXPECT_EQ(spentEnergy({line, strength, critical}, opening), strength * opening / 2);
      }
    }
}

TEST(SofteningCurve, ConcreteHasThePublishedPoints) {
  const auto at = [](const char* name, double opening) {  // of Gc/σc
    const SofteningCurve curve = softeningNamed(name);
    return envelope(lawOf(curve), opening * kUnit) / kStrength;
  };
  for (const char* name : {"bilinear", "petersson"}) {
    EXPECT_NEAR(at(name, .8), 1. / 3, 1e-12);
    EXPECT_NEAR(at(name, .4), 2. / 3, 1e-12);
    EXPECT_NEAR(lawOf(softeningNamed(name)).criticalOpening, 3.6 * kUnit, 1e-12 * kUnit);
  }
  EXPECT_NEAR(at("ceb-fip-2010", 1), .2, 1e-12);
  EXPECT_NEAR(lawOf(softeningNamed("ceb-fip-2010")).criticalOpening, 5 * kUnit, 1e-12 * kUnit);
  double exponential = 0, reinhardt = 0;
  for (double w = 0; w < 8; w += .001) {
    exponential = std::max(exponential, std::abs(at("exponential", w) - std::exp(-w)));
    const double u = w / 5.136, c = 27 * u * u * u;
    const double formula = u < 1 ? (1 + c) * std::exp(-6.93 * u) - 28 * std::exp(-6.93) * u : 0;
    reinhardt = std::max(reinhardt, std::abs(at("reinhardt", w) - formula));
  }
  EXPECT_LT(exponential, .001);
  EXPECT_LT(reinhardt, .001);
}

TEST(SofteningCurve, TheSteepestLineBoundsEveryFall) {
  for (const auto& [name, curve] : softeningCurves()) {
    const TensionLaw law = lawOf(curve);
    const double steep = curve.steepOpening(kStrength, kEnergy);
    double slope = 0;
    const double dw = law.criticalOpening / 1e5;
    for (int i = 0; i < 100000; ++i)
      slope = std::max(slope, (envelope(law, i * dw) - envelope(law, (i + 1) * dw)) / dw);
    EXPECT_NEAR(slope * steep / kStrength, 1, 1e-4) << name;
    EXPECT_NEAR(curve.steepPart(), std::min(1., kStrength * steep / 2 / kEnergy), 1e-12) << name;
  }
  EXPECT_NEAR(softeningNamed("petersson").steepPart(), .6, 1e-12);
  EXPECT_NEAR(softeningNamed("exponential").steepPart(), .5, .02);
}

}  // namespace
}  // namespace yadefrag::test
