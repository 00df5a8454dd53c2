#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "elements/blocks.hpp"
#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

TEST(CriticalTimeStep, IsASafeAndSharpBoundOfTheFastestMode) {
  for (const double poisson : {0., .3, .49}) {
    ElasticMaterial material = kSteel;
    material.poisson = poisson;
    expectBound(square(5, material), 1.4);
    expectBound(smoothed(square(5, material)), 1.8);
    material.planeStress = true;
    expectBound(square(5, material), 1.4);
  }
  Model slivers;
  appendBlock(slivers, {0, 0}, {.1, .01}, 5, 20);
  expectBound(slivers, 1.4);
  expectBound(smoothed(slivers), 2.1);
}

TEST(CriticalTimeStep, OfOneTriangleIsExact) {
  const Model model = modelOf(test::oneTriangle({0, 0}, {.01, .002}, {.003, .008}), kSteel);
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

/// Growth of the kinetic energy of a tiny noise; of a body that is stretched, and held around it.
double growth(const StepSettings& settings, double factor, double stretch = 1) {
  Model model = square(5);
  for (Vec2& x : model.nodes.position) x *= stretch;
  shake(model, 1e-4);
  for (std::size_t n = 0; n < model.nodes.size() && stretch != 1; ++n) {
    const Vec2 x = model.nodes.reference[n];
    if (std::abs(x.x) < .00999 && std::abs(x.y) < .00999) continue;
    model.nodes.held[n] = kHeldXY;
    model.nodes.velocity[n] = {};
  }
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
  for (const double stretch : {1.5, 3.}) EXPECT_LT(growth({}, .99, stretch), 10) << stretch;
}

TEST(CriticalTimeStep, ViscosityLowersItAndItStaysFinite) {
  const StepSettings viscous{.viscosity = {.5, 1.2}};
  const Model model = square(5);
  double before = criticalTimeStep(model);
  EXPECT_LT(criticalTimeStep(model, viscous.viscosity), .8 * before);
  EXPECT_LT(growth(viscous, .99), 10);
  EXPECT_GT(growth(viscous, 2), 1e6);
  for (const double linear : {1., 1e10, 1e80, 1e160}) {
    const double step = criticalTimeStep(model, {linear, 0});
    EXPECT_GT(step, 0) << linear;
    EXPECT_LT(step, before) << linear;
    before = step;
  }
}

// --- Resistance to collapse: below `kBarrierBegin` of its area an element gets the stiffer the
// flatter it is.

constexpr ElasticMaterial kSoft{.young = 5e6, .poisson = .4, .density = 1100};
constexpr ElementKind kKinds[] = {ElementKind::kLinear, ElementKind::kSmoothed};

/// A block pressed to a part of its height, and turned.
Model pressed(double part, ElementKind kind, int side = 3) {
  Model model = square(side, kSoft, .01);
  for (Component& component : model.components) component.element = kind;
  for (Vec2& x : model.nodes.position) x.y *= part;
  turn(model, .4);
  return model;
}

/// (J) Without the barrier. In a uniform strain smoothed bodies have the same.
double elasticEnergy(const Model& model) {
  double sum = 0;
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    sum +=
        .01 * model.triangles.area[e] *
        energyDensity(deformationGradient(model, ElementId(e)), kSoft.lame(), kSoft.shearModulus());
  return sum;
}

TEST(Collapse, NothingChangesAboveAndAnyEnergyIsReachedBelow) {
  for (const ElementKind kind : kKinds) {
    for (const double part : {.9, .5, .2001}) {
      const Model model = pressed(part, kind);
      EXPECT_NEAR(strainEnergy(model, 0) / elasticEnergy(model), 1, 1e-12) << part;
    }
    double last = 1;
    for (const double part : {.15, .1, .01, 1e-3, 1e-4}) {
      const Model model = pressed(part, kind);
      const double ratio = strainEnergy(model, 0) / elasticEnergy(model);
      EXPECT_GT(ratio, last) << part;
      last = ratio;
    }
    EXPECT_GT(last, 100);
  }
}

TEST(Collapse, ForcesAreTheGradientOfTheEnergy) {
  for (const ElementKind kind : kKinds)
    expectForcesAreTheGradient(pressed(.08, kind), 2e-5, 1e-8, 1e-5);
}

/// σ of a uniform strain times the area of the turned, pressed side is the force on it.
TEST(Collapse, StressesContainTheBarrier) {
  for (const ElementKind kind : kKinds) {
    const Model model = pressed(.05, kind);
    const std::vector<Vec2> forces = forcesOf(model);
    const Vec2 normal{-std::sin(.4), std::cos(.4)};
    double force = 0;  // of the body on what presses its upper side
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      if (dot(model.nodes.position[n], normal) > .05 * .01 - 1e-9) force += dot(forces[n], normal);
    for (const auto& [xx, yy, xy] : stresses(model)) {
      const double along =
          xx * normal.x * normal.x + yy * normal.y * normal.y + 2 * xy * normal.x * normal.y;
      EXPECT_NEAR(-along * .02 * .01 / force, 1, 1e-9);
    }
  }
}

TEST(Collapse, TheCriticalStepIsABound) {
  for (const ElementKind kind : kKinds)
    for (const double part : {.5, .19, .15, .1, .05, .01}) {
      SCOPED_TRACE(part);
      expectBound(pressed(part, kind, 2), part < .2 ? 4 : 2.5);
    }
  EXPECT_LT(criticalTimeStep(pressed(.05, kKinds[0])),
            .2 * criticalTimeStep(pressed(.21, kKinds[0])));
}

}  // namespace
}  // namespace yadefrag
