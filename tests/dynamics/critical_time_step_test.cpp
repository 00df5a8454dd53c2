#include <gtest/gtest.h>
#include <algorithm>
#include <limits>

#include <cmath>

#include "dynamics/blocks.hpp"

namespace yadefrag {
namespace {

constexpr double kTiny = 1e-9;  // of the nodes' distances: geometry is linear

/// 2/ω of the fastest mode of the assembled mesh, by power iteration on M⁻¹K.
double trueCriticalStep(const Model& model) {
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
    for (std::size_t n = 0; n < mode.size(); ++n)
      moved.nodes.position[n] = model.nodes.position[n] + kTiny / scale * mode[n];
    dynamics.predict(moved, 0, {}, {}, 1);
    for (std::size_t n = 0; n < mode.size(); ++n) {
      const Vec2 stiff = -scale / kTiny * dynamics.internalForces()[n];
      energy += dot(mode[n], stiff);
      mass += model.nodes.mass[n] * dot(mode[n], mode[n]);
      mode[n] = 1 / (scale * model.nodes.mass[n] * omega2) * stiff;
    }
    omega2 = energy / mass;
  }
  return 2 / std::sqrt(omega2);
}

void checkBound(const Model& model, double sharpness) {
  const double bound = criticalTimeStep(model);
  const double truth = trueCriticalStep(model);
  EXPECT_LE(bound, truth * 1.0001);
  EXPECT_GE(bound, truth / sharpness);
}

TEST(CriticalTimeStep, IsASafeAndSharpBoundOfTheFastestMode) {
  for (const double poisson : {0., .3, .49}) {
    ElasticMaterial material = kSteel;
    material.poisson = poisson;
    checkBound(square(5, material), 1.4);
    material.planeStress = true;
    checkBound(square(5, material), 1.4);
  }
  Model slivers;
  appendBlock(slivers, {0, 0}, {.1, .01}, 5, 20);
  checkBound(slivers, 1.4);
}

TEST(CriticalTimeStep, HoldsWithSmoothedStrains) {
  for (const double poisson : {0., .3, .49}) {
    ElasticMaterial material = kSteel;
    material.poisson = poisson;
    checkBound(smoothed(square(5, material)), 1.8);
  }
  Model slivers;
  appendBlock(slivers, {0, 0}, {.1, .01}, 5, 20);
  checkBound(smoothed(slivers), 2.1);
}

TEST(CriticalTimeStep, OfOneTriangleIsExact) {
  TriangleMesh mesh;
  mesh.nodes = {{0, 0}, {.01, .002}, {.003, .008}};
  mesh.triangles = {{0, 1, 2}};
  Component component;
  component.material = kSteel;
  Model model;
  appendBody(model, mesh, component);
  EXPECT_NEAR(criticalTimeStep(model) / trueCriticalStep(model), 1, 1e-4);
}

TEST(CriticalTimeStep, FollowsTheElementSizeAndTheWaveSpeed) {
  const double step = criticalTimeStep(square(8));
  EXPECT_NEAR(criticalTimeStep(square(16)) / step, .5, .05);
  ElasticMaterial soft = kSteel;
  soft.young /= 4;
  EXPECT_NEAR(criticalTimeStep(square(8, soft)) / step, 2, 1e-9);
  EXPECT_EQ(criticalTimeStep(Model{}), std::numeric_limits<double>::infinity());
}

/// The products of masses and stiffnesses on the way must not leave the range of numbers.
TEST(CriticalTimeStep, DoesNotDependOnTheThickness) {
  const double usual = criticalTimeStep(square(3, kSteel));
  for (const double thickness : {1e-290, 1e-200, 1e-100, 1e100, 1e200, 1e290}) {
    EXPECT_NEAR(criticalTimeStep(square(3, kSteel, thickness)), usual, 1e-12 * usual) << thickness;
  }
}

TEST(CriticalTimeStep, IsFiniteForAnyViscosity) {
  const Model model = square(3, kSteel);
  double before = criticalTimeStep(model);
  for (const double linear : {1., 1e10, 1e80, 1e160}) {
    const double step = criticalTimeStep(model, {linear, 0});
    EXPECT_GT(step, 0) << linear;
    EXPECT_LT(step, before) << linear;
    before = step;
  }
}

TEST(CriticalTimeStep, DoesNotDependOnThreads) {
  const Model model = square(40);
  EXPECT_EQ(criticalTimeStep(model, {}, 3), criticalTimeStep(model, {}, 1));
}

/// Growth of the kinetic energy of a tiny noise.
double growth(const StepSettings& settings, double factor) {
  Model model = square(5);
  shake(model, 1e-4);
  Stepper run = runOf(std::move(model), factor, settings);
  const double before = run.kinetic();
  double after = before;
  for (int i = 0; i < 3000 && after < 1e6 * before; ++i) {
    run.step();
    after = run.kinetic();
  }
  return after / before;
}

TEST(CriticalTimeStep, StableBelowUnstableWellAbove) {
  EXPECT_LT(growth({}, .99), 10);
  EXPECT_GT(growth({}, 1.5), 1e6);
}

TEST(CriticalTimeStep, BulkViscosityLowersIt) {
  const StepSettings viscous{.viscosity = {.5, 1.2}};
  const Model model = square(5);
  EXPECT_LT(criticalTimeStep(model, viscous.viscosity), .8 * criticalTimeStep(model));
  EXPECT_LT(growth(viscous, .99), 10);
  EXPECT_GT(growth(viscous, 2), 1e6);
}

/// Random velocities on a body that is stretched or squeezed: is the bound still safe there?
double growthWhenStretched(double stretch) {
  Model model = square(5);
  for (Vec2& x : model.nodes.position) x *= stretch;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    const double edge = .00999 * stretch;
    if (std::abs(x.x) > edge || std::abs(x.y) > edge) model.nodes.held[n] = kHeldXY;
  }
  shake(model, 1e-4);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes.held[n] != kFree) model.nodes.velocity[n] = {};
  Stepper run = runOf(std::move(model), .99);
  const double before = run.kinetic();
  run.step(2000);
  return run.kinetic() / before;
}

TEST(CriticalTimeStep, HoldsInLargeStrain) {
  EXPECT_LT(growthWhenStretched(1.5), 10);
  EXPECT_LT(growthWhenStretched(3), 10);
}

}  // namespace
}  // namespace yadefrag
