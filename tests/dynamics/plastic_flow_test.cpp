// Bodies that yield, in steps: forces, energy balance, undoing, bits.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "dynamics/blocks.hpp"
#include "dynamics/element_state.hpp"

namespace yadefrag {
namespace {

constexpr ElementKind kKinds[] = {ElementKind::kLinear, ElementKind::kSmoothed};

/// A square of 20 mm of copper or steel that yields.
Model yielding(ElementKind kind, int side = 8, double yield = 400e6, bool planeStress = false) {
  Model model;
  TriangleMesh mesh = structuredRectangle({-.01, -.01}, {.01, .01}, side, side);
  Component c;
  c.material = kSteel;
  c.material.planeStress = planeStress;
  c.element = kind;
  c.plastic.yieldStress = yield, c.plastic.hardening = 300e6, c.plastic.hardeningExponent = .3;
  c.plastic.rateFactor = .02, c.plastic.heatCapacity = 480;
  c.plastic.thermalExponent = 1, c.plastic.meltTemperature = 1800;
  appendBody(model, mesh, c);
  return model;
}

/// Laws for which the loops differ: vector loops, a table, for which there is none, and a cone.
std::vector<PlasticMaterial> laws() {
  const PlasticMaterial johnsonCook = yielding(ElementKind::kLinear, 1).components[0].plastic;
  PlasticMaterial straight{.yieldStress = 400e6, .hardening = 1e9, .heatCapacity = 480};
  PlasticMaterial rated = straight;
  rated.rateFactor = .01;
  const PlasticMaterial power{.yieldStress = 400e6, .hardeningExponent = .2, .offsetStrain = .01};
  const PlasticMaterial table{.table = {{0, 400e6}, {.01, 450e6}}};
  const PlasticMaterial cone{.cohesion = 300e6, .internalFriction = .4, .dilation = .2};
  return {johnsonCook, {.yieldStress = 400e6}, straight, rated, power, table, cone};
}

/// Bulges and shears by velocities up to `most` (m/s).
void launch(Model& model, double most) {
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    model.nodes.velocity[n] = most * Vec2{x.x / .01 + x.y / .02, std::sin(150 * x.x) * x.y / .01};
  }
}

TEST(PlasticFlow, SmallStrainsGiveTheElasticForces) {
  for (const bool planeStress : {false, true})
    for (const ElementKind kind : kKinds) {
      Model model = yielding(kind, 8, 1e12, planeStress);
      Model elastic = model;
      elastic.components[0].plastic = {};
      elastic.components[0].element = ElementKind::kLinear;
      elastic.triangles.plastic = {};
      // A uniform strain, with a rotation: means at nodes change nothing.
      for (Model* one : {&model, &elastic})
        for (Vec2& x : one->nodes.position)
          x = Vec2{.8 * x.x * 1.0001 - .6 * x.y, .6 * x.x + .8 * x.y};
      const std::vector<Vec2> a = forcesOf(model), b = forcesOf(elastic);
      double most = 0, difference = 0;
      for (std::size_t n = 0; n < a.size(); ++n)
        most = std::max(most, norm(b[n])), difference = std::max(difference, norm(a[n] - b[n]));
      EXPECT_LT(difference, 3e-4 * most);
    }
}

/// Kinetic, strain and plastic energy together, of the kinetic energy at the start.
double energyError(Model model, double speed, double factor, int steps) {
  launch(model, speed);
  Stepper run = runOf(std::move(model), factor);
  const double start = run.kinetic();
  double plastic = 0, most = 0;
  for (int i = 0; i < steps; ++i) {
    run.step();
    plastic += run.dynamics.flow().dissipation();
    if (i % 20 != 19) continue;
    const YieldingEnergy now = yieldingEnergy(run.model, run.dt);
    most = std::max(most, std::abs(run.kinetic() + now.strain + plastic + now.dissipated - start));
  }
  EXPECT_GT(plastic, .3 * start);
  return most / start;
}

TEST(PlasticFlow, EnergyIsBalanced) {
  for (const ElementKind kind : kKinds) {
    EXPECT_LT(energyError(yielding(kind), 40, .5, 400), 1e-5);
    EXPECT_LT(energyError(yielding(kind, 8, 400e6, true), 40, .5, 400), 1e-5);
  }
}

/// Of frictional materials, whose volume changes as they flow, at strains of 3 %.
TEST(PlasticFlow, EnergyOfFrictionalMaterials) {
  for (const double dilation : {0., .3, .5})
    for (const ElementKind kind : kKinds) {
      Model model;
      Component c;
      c.material = {1e9, .3, 2000, false};
      c.element = kind;
      c.plastic.cohesion = 1e6, c.plastic.internalFriction = .5, c.plastic.dilation = dilation;
      appendBody(model, structuredRectangle({-.01, -.01}, {.01, .01}, 8, 8), c);
      EXPECT_LT(energyError(std::move(model), 20, .5, 400), 1e-5) << dilation;
    }
}

TEST(PlasticFlow, TheSameBitsAnyhow) {
  for (const PlasticMaterial& law : laws())
    for (const ElementKind kind : kKinds) {
      Model model = yielding(kind, 40);
      model.components[0].plastic = law;
      launch(model, 60);
      const Model end = expectSameBits(model, .5, 100);
      EXPECT_GT(*std::ranges::max_element(end.triangles.plastic.strain), .01);
    }
}

/// The loops of a step return triangles as returnToYield does; the vector loops to the tolerance of
/// Δp.
TEST(PlasticFlow, LanesAgreeWithTheReturnOfOneTriangle) {
  for (const PlasticMaterial& law : laws()) {
    Model model = yielding(ElementKind::kSmoothed, 11);  // the last group of lanes is not full
    model.components[0].plastic = law;
    launch(model, 60);
    Stepper run = runOf(model, .5);
    double most = 0;
    for (int i = 0; i < 100; ++i) {
      const std::vector<YieldPoint> points = presentPoints(run.model, run.dt);
      run.step();
      const PlasticState& state = run.model.triangles.plastic;
      for (std::size_t e = 0; e < points.size(); ++e) {
        const YieldPoint found(state, e), &right = points[e];
        for (std::size_t j = 0; j < 4; ++j)
          most = std::max(most, std::abs(found.edges[j] - right.edges[j]) /
                                    std::abs(right.edges[0] + right.edges[3]));
        most = std::max({most, std::abs(found.thickness - right.thickness),
                         std::abs(found.strain - right.strain),
                         std::abs(found.temperature - right.temperature) / 293});
      }
    }
    EXPECT_GT(*std::ranges::max_element(run.model.triangles.plastic.strain), .01);
    EXPECT_LT(most, 1e-12);
  }
}

TEST(PlasticFlow, TakenBackStepsAreRepeatedWithTheSameBits) {
  for (const PlasticMaterial& law : laws()) {
    Model model = yielding(ElementKind::kSmoothed);
    model.components[0].plastic = law;
    launch(model, 60);
    Stepper one = runOf(model, .5), other = runOf(model, .5);
    one.step(60), other.step(60);
    const Model before = one.model;
    one.dynamics.predict(one.model, StepLength(one.dt, one.last), {}, {}, 1);
    EXPECT_FALSE(sameState(one.model, before));
    one.dynamics.takeBack(one.model);
    EXPECT_TRUE(sameState(one.model, before));
    // A step that ends in an error changes nothing either.
    one.model.nodes.velocity[0].x = NAN;
    EXPECT_THROW(one.step(), RunError);
    one.model.nodes.velocity[0].x = before.nodes.velocity[0].x;
    EXPECT_TRUE(sameState(one.model, before));
    one.step(60), other.step(60);
    EXPECT_TRUE(sameState(one.model, other.model));
  }
}

/// A rotation of a body that has flowed gives no forces, and its stress turns with it.
TEST(PlasticFlow, RotationsAreExact) {
  for (const ElementKind kind : kKinds) {
    Model model = yielding(kind);
    launch(model, 60);
    Stepper run = runOf(model, .5);
    run.step(100);
    const std::vector<Vec2> before = forcesOf(run.model);
    const double c = std::cos(2.), s = std::sin(2.);
    for (auto* field : {&run.model.nodes.position, &run.model.nodes.velocity})
      for (Vec2& x : *field) x = Vec2{c * x.x - s * x.y, s * x.x + c * x.y};
    const std::vector<Vec2> after = forcesOf(run.model);
    double most = 0, difference = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
      const Vec2 turned{c * before[n].x - s * before[n].y, s * before[n].x + c * before[n].y};
      most = std::max(most, norm(turned));
      difference = std::max(difference, norm(turned - after[n]));
    }
    EXPECT_LT(difference, 1e-10 * most);
  }
}

TEST(PlasticFlow, NoStateWithoutMaterialsThatYield) {
  EXPECT_FALSE(square().triangles.plastic.isUsed());
  Model model = square();
  Component c;
  c.material = kSteel, c.plastic.yieldStress = 1e8;
  const ComponentId id = appendBody(model, structuredRectangle({.02, 0}, {.03, .01}, 2, 2), c);
  EXPECT_TRUE(model.triangles.plastic.isUsed());
  EXPECT_TRUE(haveLength(model.triangles.columns(), model.triangles.size()));
  removeBody(model, id);
  EXPECT_FALSE(model.triangles.plastic.isUsed());
}

}  // namespace
}  // namespace yadefrag
