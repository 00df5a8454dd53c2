// The elastic law: stress of uniform strain, forces as the gradient of the energy, rotation.
#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <numeric>

#include "dynamics/blocks.hpp"
#include "dynamics/element_state.hpp"
#include "dynamics/spin.hpp"

namespace yadefrag {
namespace {

double energyOf(const Model& model) {
  const std::vector<double> all = elementEnergies(model);
  return std::accumulate(all.begin(), all.end(), 0.);
}

void turn(Model& model, double angle) {
  for (Vec2& x : model.nodes.position)
    x = {std::cos(angle) * x.x - std::sin(angle) * x.y,
         std::sin(angle) * x.x + std::cos(angle) * x.y};
}

/// Cauchy stress of the stretches 1 + a and 1 + b, which the law gives exactly at any size.
void checkPatch(const ElasticMaterial& material, double cxx, double cxy, ElementKind element) {
  const double a = .02;
  const double b = -.007;
  Model model = square(6, material);
  model.components[0].element = element;
  for (Vec2& x : model.nodes.position) x = {(1 + a) * x.x, (1 + b) * x.y};
  const double sx = (cxx * a + cxy * b) / (1 + b);
  const double sy = (cxy * a + cxx * b) / (1 + a);
  // Rounding of F: 1e-16 · E, with room for the division by small edges.
  const double rounding = 1e-14 * material.young;
  for (const auto& s : stresses(model)) {
    EXPECT_NEAR(s[0], sx, rounding);
    EXPECT_NEAR(s[1], sy, rounding);
    EXPECT_NEAR(s[2], 0, rounding);
  }
  const std::vector<Vec2> force = forcesOf(model);
  for (std::size_t n = 0; n < force.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    if (std::abs(x.x) < .0099 && std::abs(x.y) < .0099) {
      EXPECT_LT(norm(force[n]), rounding * .02) << "inner node " << n;
    }
  }
  turn(model, .5);
  const double mean = (sx + sy) / 2;
  const double half = (sx - sy) / 2;
  for (const auto& s : stresses(model)) {
    EXPECT_NEAR(s[0], mean + half * std::cos(1.), rounding);
    EXPECT_NEAR(s[1], mean - half * std::cos(1.), rounding);
    EXPECT_NEAR(s[2], half * std::sin(1.), rounding);
  }
}

TEST(Forces, UniformPlaneStrainIsExact) {
  const double e = kSteel.young / (1.3 * .4);
  for (const ElementKind kind : {ElementKind::kLinear, ElementKind::kSmoothed})
    checkPatch(kSteel, e * .7, e * .3, kind);
}

TEST(Forces, UniformPlaneStressIsExact) {
  ElasticMaterial material = kSteel;
  material.planeStress = true;
  const double e = material.young / (1 - .09);
  for (const ElementKind kind : {ElementKind::kLinear, ElementKind::kSmoothed})
    checkPatch(material, e, e * .3, kind);
}

void checkGradient(Model model) {
  turn(model, 2);
  shake(model, 3e-4);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    model.nodes.position[n] += model.nodes.velocity[n];
  const std::vector<Vec2> force = forcesOf(model);
  const double h = 1e-8;
  double largest = 0;
  for (const Vec2 f : force) largest = std::max(largest, norm(f));
  for (std::size_t n = 0; n < force.size(); ++n)
    for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
      Model moved = model;
      moved.nodes.position[n].*axis += h;
      const double after = energyOf(moved);
      moved.nodes.position[n].*axis -= 2 * h;
      // Rounding of the energies over 2h: some 1e-8 of the largest force.
      EXPECT_NEAR(force[n].*axis, (energyOf(moved) - after) / (2 * h), 1e-7 * largest);
    }
}

TEST(Forces, AreMinusTheGradientOfTheEnergy) {
  checkGradient(square(3, kSteel, .7));
  checkGradient(smoothed(square(3, kSteel, .7)));
  checkGradient(smoothed(square(3, {.young = 2e6, .poisson = .49, .density = 1000})));
}

void checkRotation(const Model& model) {
  for (const double angle : {1e-9, .3, 1.6, 3.1415926, 4., 6.2}) {
    Model turned = model;
    turn(turned, angle);
    // Rounding of coordinates over edges, times E.
    for (const auto& s : stresses(turned))
      EXPECT_LT(std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2]), 1e-13 * kSteel.young) << angle;
  }
}

TEST(Forces, RotationAloneGivesNone) {
  checkRotation(square());
  checkRotation(smoothed(square()));
}

TEST(Forces, ABlockSpunThroughTenTurnsKeepsItsEnergyAndShowsNoFalseStress) {
  const double spin = 1e4;  // rad/s: 140 m/s at the corners
  expectNoFalseStressIn(square(), spin, [&](double dt) {
    return static_cast<int>(10 * 2 * std::numbers::pi / spin / dt);
  });
}

}  // namespace
}  // namespace yadefrag
