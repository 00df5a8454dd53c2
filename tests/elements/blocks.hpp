#pragma once
// Bodies for the tests of the dynamics.

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <utility>

#include "core/checks.hpp"
#include "elements/element_state.hpp"
#include "mesh/assembly.hpp"
#include "mesh/shapes.hpp"
#include "meshing/triangulate.hpp"
#include "time/critical_time_step.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

/// Steel: no round numbers, and every term of the law counts.
inline constexpr ElasticMaterial kSteel{
    .young = 210e9, .poisson = .3, .density = 7800, .planeStress = false};

/// Appends nx × ny quads, whose inner nodes are moved about by up to a fifth of a quad.
inline ComponentId appendBlock(Model& model, Vec2 low, Vec2 high, int nx, int ny,
                               const Component& component) {
  TriangleMesh mesh = structuredRectangle(low, high, nx, ny);
  test::jitter(
      mesh, {.2 * (high.x - low.x) / nx, .2 * (high.y - low.y) / ny}, std::mt19937_64(5),
      [&](Vec2 x) {
        return x.x > low.x && x.x < high.x && x.y > low.y && x.y < high.y ? Vec2{1, 1} : Vec2{};
      });
  return appendBody(model, mesh, component);
}
inline ComponentId appendBlock(Model& model, Vec2 low, Vec2 high, int nx, int ny,
                               const ElasticMaterial& material = kSteel, double thickness = 1) {
  Component component;
  component.material = material;
  component.thickness = thickness;
  return appendBlock(model, low, high, nx, ny, component);
}

inline Model modelOf(const TriangleMesh& mesh, const ElasticMaterial& material,
                     ElementKind element = ElementKind::kLinear) {
  Component component;
  component.material = material;
  component.element = element;
  Model model;
  appendBody(model, mesh, component);
  return model;
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

inline void turn(Model& model, double angle) {
  for (Vec2& x : model.nodes.position) x = test::turnedBy(x, angle);
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

/// 2/ω of the fastest mode of the assembled mesh, by power iteration on M⁻¹K, around its present
/// shape.
inline double trueCriticalStep(const Model& model) {
  constexpr double kTiny = 1e-9;  // of the nodes' distances: geometry is linear
  Model moved = model;
  shake(moved, 1);
  std::vector<Vec2> mode = moved.nodes.velocity;
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  double omega2 = 1;
  for (int i = 0; i < 3000; ++i) {
    double scale = 0;
    for (const Vec2 u : mode) scale = std::max(scale, norm(u));
    double energy = 0;
    double mass = 0;
    std::vector<Vec2> difference(mode.size());  // of the forces on either side
    for (const double side : {1., -1.}) {
      for (std::size_t n = 0; n < mode.size(); ++n)
        moved.nodes.position[n] = model.nodes.position[n] + side * kTiny / scale * mode[n];
      dynamics.predict(moved, 0, {}, {}, 1);
      for (std::size_t n = 0; n < mode.size(); ++n)
        difference[n] += side * dynamics.internalForces()[n];
      for (std::size_t n = 0; n < mode.size(); ++n)
        if (model.isOnAxis(NodeId(n))) difference[n].x = 0;
    }
    for (std::size_t n = 0; n < mode.size(); ++n) {
      const Vec2 stiff = -scale / (2 * kTiny) * difference[n];
      energy += dot(mode[n], stiff);
      mass += model.nodes.mass[n] * dot(mode[n], mode[n]);
      mode[n] = 1 / (scale * model.nodes.mass[n] * omega2) * stiff;
    }
    omega2 = energy / mass;
  }
  return 2 / std::sqrt(omega2);
}

/// The critical step is at most that of the fastest mode, and at least that over `sharpness`.
inline void expectBound(const Model& model, double sharpness) {
  const double bound = criticalTimeStep(model), truth = trueCriticalStep(model);
  EXPECT_LE(bound, truth * 1.0001);
  EXPECT_GE(bound, truth / sharpness);
}

/// Moves all nodes by up to `most` (m); forces are then the slopes of the energy, by differences of
/// a way `h` (m) to either side, but for `tolerance` of the largest force.
inline void expectForcesAreTheGradient(Model model, double most, double h, double tolerance) {
  shake(model, most);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    model.nodes.position[n] += model.nodes.velocity[n];
  const std::vector<Vec2> forces = forcesOf(model);
  double largest = 0;
  for (const Vec2 force : forces) largest = std::max(largest, norm(force));
  for (std::size_t n = 0; n < forces.size(); ++n)
    for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
      const auto at = [&](double way) {
        Model moved = model;
        moved.nodes.position[n].*axis += way;
        return strainEnergy(moved, 0);
      };
      EXPECT_NEAR(forces[n].*axis, (at(-h) - at(h)) / (2 * h), tolerance * largest);
    }
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
