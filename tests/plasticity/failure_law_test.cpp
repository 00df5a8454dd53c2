// The failure strain, and the damage of triangles that flow.

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/plastic_flow.hpp"
#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

/// Steel 4340, Johnson and Cook 1985.
PlasticMaterial steel4340() {
  PlasticMaterial m;
  m.yieldStress = 792e6, m.meltTemperature = 1793, m.thermalExponent = 1;
  m.failure.d1 = .05, m.failure.d2 = 3.44, m.failure.d3 = -2.12;
  m.failure.d4 = .002, m.failure.d5 = .61;
  return m;
}

TEST(FailureLaw, FailureStrainIsJohnsonAndCooks) {
  const FailureLaw law = steel4340().failure;
  EXPECT_NEAR(failureStrain(law, {1. / 3, 1, 0}), .05 + 3.44 * std::exp(-2.12 / 3), 1e-12);
  EXPECT_NEAR(failureStrain(law, {0, 1e4, .5}), 3.49 * (1 + .002 * std::log(1e4)) * (1 + .61 * .5),
              1e-12);
  // Slower than the reference rate, and beyond the bound of the triaxiality.
  EXPECT_EQ(failureStrain(law, {0, 1e-3, 0}), failureStrain(law, {0, 1, 0}));
  EXPECT_EQ(failureStrain(law, {7, 1, 0}), failureStrain(law, {1.5, 1, 0}));
  FailureLaw least = law;
  least.strain = .3;
  EXPECT_EQ(failureStrain(least, {1.5, 1, 0}), .3);
  EXPECT_GT(failureStrain(least, {-1, 1, 0}), 20);
  FailureLaw constant;
  constant.strain = .4;
  EXPECT_EQ(failureStrain(constant, {1.2, 1e5, .9}), .4);
}

TEST(FailureLaw, DamageIsTheSumOverTheFlow) {
  const PlasticMaterial m = steel4340();
  // In pure shear, without heat.
  const double whole = 3.49 * (1 + .002 * std::log(100.));
  double damage = 0;
  for (int i = 0; i < 100; ++i) damage = damageAfter(m, damage, {.01, 293, 0, 792e6, 1, 1}, 1e-4);
  EXPECT_NEAR(damage, 1 / whole, 1e-12);
  EXPECT_EQ(damageAfter(m, .9, {1, 293, 0, 792e6, 1, 1}, 1e-4), 1);
  EXPECT_EQ(damageAfter(m, .2, {0, 293, 1e9, 792e6, 1, 1}, 1e-4), .2);  // no flow
  PlasticMaterial spalls = m;
  spalls.failure.spallStress = 2e9;
  EXPECT_EQ(damageAfter(spalls, .2, {0, 293, 1.99e9, 792e6, 1, 1}, 1e-4), .2);
  EXPECT_EQ(damageAfter(spalls, .2, {0, 293, 2.01e9, 792e6, 1, 1}, 1e-4), 1);
  // A resistance is a factor of both.
  EXPECT_EQ(damageAfter(spalls, .2, {0, 293, 2.01e9, 792e6, 1, 1.1}, 1e-4), .2);
  EXPECT_DOUBLE_EQ(damageAfter(m, 0, {.01, 293, 0, 792e6, 1, 2}, 1e-4),
                   damageAfter(m, 0, {.01, 293, 0, 792e6, 1, 1}, 1e-4) / 2);
}

TEST(FailureLaw, WrongConstantsAreRefused) {
  const auto sentence = [](auto change) {
    PlasticMaterial m = steel4340();
    m.failure.energy = 1e4;
    change(m.failure);
    return m.wrong();
  };
  EXPECT_EQ(sentence([](FailureLaw&) {}), "");
  EXPECT_EQ(sentence([](FailureLaw& f) { f.strain = 0; }),
            "failureStrain is 0; it must be positive, or infinite for none.");
  EXPECT_EQ(sentence([](FailureLaw& f) { f.strain = -1; }),
            "failureStrain is -1; it must be positive, or infinite for none.");
  EXPECT_EQ(sentence([](FailureLaw& f) { f.d3 = 2.12; }),
            "failureD3 is 2.12; it must be 0 or negative, since tension reduces the failure "
            "strain.");
  EXPECT_NE(sentence([](FailureLaw& f) { f.d1 = -.2; }).find("it must be positive there"),
            std::string::npos);
  EXPECT_EQ(sentence([](FailureLaw& f) { f.d1 = -.2, f.strain = .1; }), "");
  EXPECT_NE(sentence([](FailureLaw& f) { f.d2 = -1; }).find("failureD2 is -1"), std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f.d4 = -.05; }).find("failureD4 is -0.05"),
            std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f.d5 = -1; }).find("failureD5 is -1"), std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f.d1 = NAN; }).find("failureD1 is nan"),
            std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f = {}, f.d4 = .01; }).find("failureD4 is 0.01"),
            std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f.spallStress = 0; }).find("spallStress is 0 Pa"),
            std::string::npos);
  EXPECT_EQ(sentence([](FailureLaw& f) { f.spallStress = 1e9, f.energy = 0; }),
            "fractureEnergy is 0 J/m²; it must be positive if spallStress is given, as a spall "
            "must take energy.");
  EXPECT_NE(sentence([](FailureLaw& f) { f = {}, f.energy = 1; }).find("it must be 0 unless"),
            std::string::npos);
  EXPECT_NE(sentence([](FailureLaw& f) { f.energy = -1; }).find("fractureEnergy is -1 J/m²"),
            std::string::npos);
}

// --- The energy balance of a body that yields where the step becomes shorter, as FESolver makes it
// when flow flattens triangles.

TEST(StepChange, OfABodyThatYieldsAddsNoEnergy) {
  for (const ElementKind kind : {ElementKind::kLinear, ElementKind::kSmoothed}) {
    World world;
    world.addBody(turnedMesh({{{0, 0}, {.02, 0}, {.02, .02}, {0, .02}}, {}}, .002, 0),
                  idealSteel(300e6, kind));
    for (std::size_t n = 0; n < world.model.nodes.size(); ++n) {
      const Vec2 x = world.model.nodes.reference[n];
      world.model.nodes.velocity[n] = {2e3 * x.x, -40 * std::sin(150 * x.x)};
    }
    const double start = world.kineticEnergy();
    const auto total = [&] {
      return world.ledger.total(world.kineticEnergy(), world.strainEnergy()) +
             world.pendingPlastic();
    };
    double dt = .9 * world.criticalTimeStep();
    for (int i = 0; i < 10; ++i) world.step(dt);
    EXPECT_GT(world.ledger.plastic, .03 * start);
    const double before = total();
    for (int change = 0; change < 3; ++change) {
      dt *= .6;
      for (int i = 0; i < 5; ++i) world.step(dt);
    }
    // That of the highest modes between two half steps.
    EXPECT_GT(std::abs(world.ledger.external), 1e-4 * start);
    EXPECT_NEAR(total(), before, 1e-5 * start);
  }
}

}  // namespace
}  // namespace yadefrag::test
