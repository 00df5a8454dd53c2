#pragma once
// Bodies for the tests of the dynamics.

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <span>
#include <utility>

#include "core/checks.hpp"
#include "dynamics/critical_time_step.hpp"
#include "dynamics/explicit_dynamics.hpp"
#include "mesh/assembly.hpp"
#include "mesh/shapes.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {

/// Steel: no round numbers, and every term of the law counts.
inline constexpr ElasticMaterial kSteel{
    .young = 210e9, .poisson = .3, .density = 7800, .planeStress = false};

/// Appends nx × ny quads, whose inner nodes are moved about by up to a fifth of a quad.
inline ComponentId appendBlock(Model& model, Vec2 low, Vec2 high, int nx, int ny,
                               const ElasticMaterial& material = kSteel, double thickness = 1) {
  TriangleMesh mesh = structuredRectangle(low, high, nx, ny);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> shift(-.2, .2);
  for (Vec2& x : mesh.nodes) {
    const Vec2 by{shift(random) * (high.x - low.x) / nx, shift(random) * (high.y - low.y) / ny};
    if (x.x > low.x && x.x < high.x && x.y > low.y && x.y < high.y) x += by;
  }
  Component component;
  component.material = material;
  component.thickness = thickness;
  return appendBody(model, mesh, component);
}

/// A square of 20 mm.
inline Model square(int side = 8, const ElasticMaterial& material = kSteel, double thickness = 1) {
  Model model;
  appendBlock(model, {-.01, -.01}, {.01, .01}, side, side, material, thickness);
  return model;
}

/// The same bodies with smoothed strains.
inline Model smoothed(Model model) {
  for (Component& component : model.components) component.element = ElementKind::kSmoothed;
  return model;
}

/// (N) Forces at the present positions: those of a step of no length.
inline std::vector<Vec2> forcesOf(Model model) {
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  dynamics.predict(model, 0, {}, {}, 1);
  return {dynamics.internalForces().begin(), dynamics.internalForces().end()};
}

/// Velocities without any pattern, up to `most` in each direction.
inline void shake(Model& model, double most) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-most, most);
  for (Vec2& v : model.nodes.velocity) v = {any(random), any(random)};
}

/// A model, its solver and its ledger, stepped together.
struct Stepper {
  Model model;
  double dt;
  StepSettings settings = {};
  InstructionSet set = widestInstructionSet();
  double last = 0;  // s, the step before
  EnergyLedger ledger = {};
  ExplicitDynamics dynamics = ExplicitDynamics(set);

  void start() { dynamics.rebuild(model); }
  void step(int count = 1, std::span<const Vec2> outer = {}) {
    for (int i = 0; i < count; ++i) {
      const StepLength length(dt, last);
      dynamics.predict(model, length, settings, outer, 1);
      dynamics.finish(model, length, settings, outer, {}, ledger);
      last = dt;
    }
  }
  [[nodiscard]] double kinetic() const { return kineticEnergy(model.nodes); }
  [[nodiscard]] double strain() const { return strainEnergy(model, dt); }
  [[nodiscard]] double total() const { return ledger.total(kinetic(), strain()); }
};

/// A run of a model at `factor` of its critical step.
inline Stepper runOf(Model model, double factor, const StepSettings& settings = {}) {
  const double dt = factor * criticalTimeStep(model, settings.viscosity);
  Stepper run{.model = std::move(model), .dt = dt, .settings = settings};
  run.start();
  return run;
}

inline bool sameState(const Model& a, const Model& b) {
  const PlasticState &p = a.triangles.plastic, &q = b.triangles.plastic;
  return test::sameBits(a.nodes.position, b.nodes.position) &&
         test::sameBits(a.nodes.velocity, b.nodes.velocity) && p.edges == q.edges &&
         p.thickness == q.thickness && p.strain == q.strain && p.temperature == q.temperature;
}

/// No instruction set changes the bits of a run of so many steps of `factor` of the critical one.
/// Its end. Threads and loading: the scenes of step/eventful_scenes.cpp.
inline Model expectSameForAnySet(const Model& model, double factor, int steps,
                                 const StepSettings& settings = {}) {
  const double dt = factor * criticalTimeStep(model, settings.viscosity);
  const auto runWith = [&](InstructionSet set) {
    Stepper run{.model = model, .dt = dt, .settings = settings, .set = set};
    run.start();
    run.step(steps);
    return run;
  };
  const Stepper one = runWith(InstructionSet::kBaseline);
  for (const InstructionSet set : {bestInstructionSet(), widestInstructionSet()}) {
    const Stepper other = runWith(set);
    EXPECT_TRUE(sameState(one.model, other.model));
    EXPECT_EQ(one.ledger.external, other.ledger.external);
    EXPECT_EQ(one.ledger.damping, other.ledger.damping);
  }
  return one.model;
}

/// Laws for which the loops differ: vector loops, a table, for which there is none, and a cone.
inline std::vector<PlasticMaterial> plasticLaws() {
  PlasticMaterial johnsonCook{.yieldStress = 400e6, .hardening = 300e6, .hardeningExponent = .3};
  johnsonCook.rateFactor = .02, johnsonCook.heatCapacity = 480;
  johnsonCook.thermalExponent = 1, johnsonCook.meltTemperature = 1800;
  const PlasticMaterial straight{.yieldStress = 400e6, .hardening = 1e9, .heatCapacity = 480};
  PlasticMaterial rated = straight;
  rated.rateFactor = .01;
  const PlasticMaterial power{.yieldStress = 400e6, .hardeningExponent = .2, .offsetStrain = .01};
  const PlasticMaterial table{.table = {{0, 400e6}, {.01, 450e6}}};
  const PlasticMaterial cone{.cohesion = 300e6, .internalFriction = .4, .dilation = .2};
  return {johnsonCook, {.yieldStress = 400e6}, straight, rated, power, table, cone};
}

}  // namespace yadefrag
