#pragma once
// Bodies for the tests of the dynamics.

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <span>
#include <utility>

#include "core/checks.hpp"
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

/// A model, its solver and its ledger, stepped together.
struct Stepper {
  Model model;
  double dt;
  StepSettings settings = {};
  int threads = 1;
  InstructionSet set = widestInstructionSet();
  double last = 0;  // s, the step before
  EnergyLedger ledger = {};
  ExplicitDynamics dynamics = ExplicitDynamics(set);

  void start() { dynamics.rebuild(model); }
  void step(int count = 1, std::span<const Vec2> outer = {}) {
    for (int i = 0; i < count; ++i) {
      const StepLength length(dt, last);
      dynamics.predict(model, length, settings, outer, threads);
      dynamics.finish(model, length, settings, outer, {}, ledger, threads);
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

/// Any number of threads, any instruction set, and a solver that is built anew as after loading do
/// not change the bits of a run of so many steps of `factor` of the critical one. Its end.
inline Model expectSameBits(const Model& model, double factor, int steps,
                            const StepSettings& settings = {}) {
  const double dt = factor * criticalTimeStep(model, settings.viscosity);
  const auto runWith = [&](int threads, InstructionSet set) {
    Stepper run{.model = model, .dt = dt, .settings = settings, .threads = threads, .set = set};
    run.start();
    run.step(steps / 2);
    return run;
  };
  Stepper one = runWith(1, InstructionSet::kBaseline);
  Stepper rebuilt{
      .model = one.model, .dt = dt, .settings = settings, .last = one.last, .ledger = one.ledger};
  rebuilt.start();
  one.step(steps / 2);
  const auto expectAsOne = [&](Stepper& other) {
    other.step(steps / 2);
    EXPECT_TRUE(sameState(one.model, other.model));
    EXPECT_EQ(one.ledger.external, other.ledger.external);
    EXPECT_EQ(one.ledger.damping, other.ledger.damping);
  };
  expectAsOne(rebuilt);
  for (const auto& [threads, set] :
       {std::pair{2, InstructionSet::kBaseline}, std::pair{1, bestInstructionSet()},
        std::pair{3, widestInstructionSet()}}) {
    SCOPED_TRACE(threads);
    Stepper other = runWith(threads, set);
    expectAsOne(other);
  }
  return one.model;
}

}  // namespace yadefrag
