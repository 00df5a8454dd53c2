#include "mesh/softening_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/softening_curves.hpp"

namespace yadefrag::test {
namespace {

constexpr double kStrength = 3e6, kEnergy = 120;  // Pa, J/m²
constexpr double kUnit = kEnergy / kStrength;     // m

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
    EXPECT_EQ(envelope(law, law.criticalOpening), 0) << name;
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
      EXPECT_NEAR(spent + recoverableEnergy(law, opening, opening), areaBelow(law, opening),
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

std::string said(const std::vector<SofteningPoint>& points) {
  try {
    (void)SofteningCurve(points);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SofteningCurve, RefusesPointsThatAreNoCurveByOneSentence) {
  EXPECT_EQ(said({{0, 1}, {1, 0}}), "");
  EXPECT_NE(said({{0, 1}}).find("has 1 points"), std::string::npos);
  EXPECT_NE(said({{0, .9}, {1, 0}}).find("begins at (0, 0.9)"), std::string::npos);
  EXPECT_NE(said({{0, 1}, {.9, 0}}).find("ends at (0.9, 0)"), std::string::npos);
  EXPECT_NE(said({{0, 1}, {.5, .2}, {.5, .1}, {1, 0}}).find("openings must increase"),
            std::string::npos);
  EXPECT_NE(said({{0, 1}, {.3, .2}, {.5, .4}, {1, 0}}).find("tractions must not increase"),
            std::string::npos);
  EXPECT_NE(said({{0, 1}, {.5, -.1}, {1, 0}}), "");
  EXPECT_NE(said({{0, 1}, {NAN, .5}, {1, 0}}), "");
  EXPECT_NE(said({{0, 1}, {.5, NAN}, {1, 0}}), "");
  EXPECT_THROW((void)softeningNamed("quadratic"), InputError);
}

}  // namespace
}  // namespace yadefrag::test
