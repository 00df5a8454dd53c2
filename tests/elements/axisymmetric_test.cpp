// Bodies around an axis: x is the radius, y the place along the axis.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/blocks.hpp"
#include "elements/element_state.hpp"
#include "time/energy_ledger.hpp"

namespace yadefrag {
namespace {

enum class Law { kElastic, kSmoothed, kYielding, kAveraged, kCone };
constexpr Law kLaws[] = {Law::kElastic, Law::kSmoothed, Law::kYielding, Law::kAveraged, Law::kCone};

/// From the axis, or from `inner`, to .02 m, and .02 m high. No stress here reaches the strength.
Model cylinder(Law law, int side = 6, double inner = 0) {
  Component body;
  body.material = kSteel;
  if (law == Law::kYielding || law == Law::kAveraged) body.plastic.yieldStress = 1e12;
  if (law == Law::kCone) body.plastic.cohesion = 1e12, body.plastic.internalFriction = .5;
  if (law == Law::kAveraged || law == Law::kSmoothed) body.element = ElementKind::kSmoothed;
  Model model;
  model.axisymmetric = true;
  appendBlock(model, {inner, -.01}, {inner + .02, .01}, side, side, body);
  return model;
}

void stretchBy(Model& model, double radial, double axial) {
  for (Vec2& x : model.nodes.position) x = {x.x * (1 + radial), x.y * (1 + axial)};
}

TEST(Axisymmetric, VolumeAndMassAreThoseOfTheTurnedShape) {
  for (const double inner : {0., .03}) {
    const Model model = cylinder(Law::kElastic, 6, inner);
    const double outer = inner + .02;
    const double volume = std::numbers::pi * (outer * outer - inner * inner) * .02;
    double sum = 0, mass = 0;
    for (std::size_t e = 0; e < model.triangles.size(); ++e) sum += volumeOf(model, ElementId(e));
    for (const double one : model.nodes.mass) mass += one;
    EXPECT_NEAR(sum, volume, 1e-13 * volume);
    EXPECT_NEAR(mass, 7800 * volume, 1e-12 * 7800 * volume);
  }
}

TEST(Axisymmetric, ForcesAreTheGradientOfTheEnergy) {
  for (const Law law : kLaws) {
    Model model = cylinder(law, 4, .001);
    stretchBy(model, .02, -.03);
    // Rounding of the energy over the way.
    expectForcesAreTheGradient(model, 1e-4, 1e-8, 3e-6);
  }
}

/// A uniform stretch in all directions: σ = 3κε everywhere, no force inside, and at the surface
/// that of the pressure on the turned side.
TEST(Axisymmetric, UniformStretchHasUniformStressAndNoForceInside) {
  const double strain = 1e-4;
  for (const Law law : kLaws) {
    Model model = cylinder(law);
    stretchBy(model, strain, strain);
    const double bulk = 210e9 / (3 * (1 - 2 * .3)), stress = 3 * bulk * strain;
    const auto plane = stresses(model);
    const auto around = stressesAcross(model);
    for (std::size_t e = 0; e < plane.size(); ++e) {
      EXPECT_NEAR(plane[e][0], stress, 4e-4 * stress);
      EXPECT_NEAR(plane[e][1], plane[e][0], 1e-9 * stress);
      EXPECT_NEAR(around[e], plane[e][0], 1e-9 * stress);
    }
    const std::vector<Vec2> force = forcesOf(model);
    double upper = 0;
    const double disc = std::numbers::pi * .02 * .02;
    for (std::size_t n = 0; n < force.size(); ++n) {
      const Vec2 at = model.nodes.reference[n];
      const bool isUpper = at.y > .01 - 1e-9, isLower = at.y < -.01 + 1e-9;
      if (isUpper) upper += force[n].y;
      if (at.x > .02 - 1e-9) continue;
      EXPECT_LT(std::abs(force[n].x), 1e-9 * stress * disc);
      if (isUpper || isLower) continue;
      EXPECT_LT(std::abs(force[n].y), 1e-9 * stress * disc);
    }
    EXPECT_NEAR(-upper, stress * disc, 1e-3 * stress * disc);
  }
}

/// Against the fastest mode of the assembled mesh.
TEST(Axisymmetric, CriticalStepIsASafeAndSharpBound) {
  for (const double inner : {0., .001, 1.})
    for (const double poisson : {0., .3, .45}) {
      Model model;
      model.axisymmetric = true;
      ElasticMaterial material = kSteel;
      material.poisson = poisson;
      appendBlock(model, {inner, 0}, {inner + .02, .02}, 5, 5, material);
      expectBound(model, 1.6);
    }
}

/// Far from the axis the forces are those in plane strain, per length of the circle.
TEST(Axisymmetric, FarFromTheAxisItIsPlaneStrain) {
  const double radius = 1e4;
  Model plane, around;
  around.axisymmetric = true;
  for (Model* model : {&plane, &around}) {
    appendBlock(*model, {radius, 0}, {radius + .02, .02}, 4, 4);
    for (std::size_t n = 0; n < model->nodes.size(); ++n) {
      const Vec2 x = model->nodes.reference[n] - Vec2{radius, 0};
      model->nodes.position[n] += Vec2{1e-3 * x.x + 2e-3 * x.y, -1e-3 * x.y};
    }
  }
  const std::vector<Vec2> flat = forcesOf(plane), turned = forcesOf(around);
  for (std::size_t n = 0; n < flat.size(); ++n)
    EXPECT_LT(norm(turned[n] * (1 / (2 * std::numbers::pi * radius)) - flat[n]),
              1e-5 * 210e9 * 1e-3 * .02);
}

}  // namespace
}  // namespace yadefrag
