// The elastic law: stress of uniform strain, forces as the gradient of the energy, rotation.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "elements/blocks.hpp"
#include "elements/element_state.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {
namespace {

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

TEST(Forces, UniformStrainIsExactInPlaneStrainAndPlaneStress) {
  ElasticMaterial stressed = kSteel;
  stressed.planeStress = true;
  const double strain = kSteel.young / (1.3 * .4), stress = kSteel.young / (1 - .09);
  for (const ElementKind kind : {ElementKind::kLinear, ElementKind::kSmoothed}) {
    checkPatch(kSteel, strain * .7, strain * .3, kind);
    checkPatch(stressed, stress, stress * .3, kind);
  }
}

TEST(Forces, AreMinusTheGradientOfTheEnergy) {
  for (Model model : {square(3, kSteel, .7), smoothed(square(3, kSteel, .7)),
                      smoothed(square(3, {.young = 2e6, .poisson = .49, .density = 1000}))}) {
    turn(model, 2);
    // Rounding of the energies over 2h: some 1e-8 of the largest force.
    expectForcesAreTheGradient(model, 3e-4, 1e-8, 1e-7);
  }
}

TEST(Forces, RotationAloneGivesNone) {
  for (const Model& model : {square(), smoothed(square())})
    for (const double angle : {1e-9, .3, 1.6, 3.1415926, 4., 6.2}) {
      Model turned = model;
      turn(turned, angle);
      // Rounding of coordinates over edges, times E.
      for (const auto& s : stresses(turned))
        EXPECT_LT(std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2]), 1e-13 * kSteel.young) << angle;
    }
}

/// Ten turns around the origin, and 3000 steps of smoothed elements.
TEST(Forces, ABlockThatSpinsKeepsItsEnergyAndShowsNoFalseStress) {
  constexpr double kSpin = 1e4;  // rad/s: 140 m/s at the corners
  for (Model model : {square(), smoothed(square())}) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      model.nodes.velocity[n] = -kSpin * rightOf(model.nodes.position[n]);
    const bool isSmoothed = model.components[0].element == ElementKind::kSmoothed;
    Stepper run = runOf(std::move(model), .8);
    const double energy = run.total();
    const double steps = isSmoothed ? 3000 : 10 * 2 * std::numbers::pi / kSpin / run.dt;
    double largest = 0;
    for (int i = 0; i < steps; i += 100) {
      run.step(100);
      // 10⁻⁵: in one step the block turns by ωΔt = 2·10⁻³, whose square is the leapfrog's error.
      ASSERT_NEAR(run.total(), energy, 1e-5 * energy);
      for (const auto& s : stresses(run.model))
        largest = std::max({largest, std::abs(s[0]), std::abs(s[1]), std::abs(s[2])});
    }
    // Released without the stress of its spin, ρω²R²/2 at most for a disc around it, a body swings
    // to twice that; nothing else may add up.
    EXPECT_LT(largest, 2 * kSteel.density * kSpin * kSpin * .0002 / 2);
    EXPECT_GT(largest, 0);
  }
}

// --- Bodies with smoothed strains: modes without energy, energy and momentum, dropped triangles.

/// (N/m) −∂f/∂x at rest, by central differences.
Eigen::MatrixXd stiffnessOf(const Model& model, double h) {
  const auto count = static_cast<Eigen::Index>(2 * model.nodes.size());
  Eigen::MatrixXd stiffness(count, count);
  for (Eigen::Index column = 0; column < count; ++column) {
    Model moved = model;
    double& x =
        column % 2 == 0 ? moved.nodes.position[column / 2].x : moved.nodes.position[column / 2].y;
    x += h;
    const std::vector<Vec2> after = forcesOf(moved);
    x -= 2 * h;
    const std::vector<Vec2> before = forcesOf(moved);
    for (Eigen::Index row = 0; row < count; ++row) {
      const Vec2 change = before[row / 2] - after[row / 2];
      stiffness(row, column) = (row % 2 == 0 ? change.x : change.y) / (2 * h);
    }
  }
  return stiffness;
}

/// Three modes have no energy, the rigid ones, and all others at least `least` of the stiffest.
void checkModes(const Model& model, double least) {
  const Eigen::MatrixXd stiffness = stiffnessOf(model, 1e-8);
  const Eigen::VectorXd modes =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues();
  const double stiffest = modes[modes.size() - 1];
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(modes[i]), 1e-6 * stiffest);
  EXPECT_GT(modes[3], least * stiffest);
}

TEST(Smoothed, NoMotionButTheRigidOnesIsWithoutEnergy) {
  for (const double poisson : {0., .3, .49}) {
    const ElasticMaterial material{.young = 1, .poisson = poisson, .density = 1};
    const auto bodyOf = [&](const TriangleMesh& mesh) {
      return modelOf(mesh, material, ElementKind::kSmoothed);
    };
    for (const QuadPattern pattern : {QuadPattern::kUnionJack, QuadPattern::kCrossed})
      checkModes(bodyOf(structuredRectangle({0, 0}, {1, 1}, 4, 4, pattern)), 1e-3);
    checkModes(bodyOf(structuredRectangle({0, 0}, {1, 1}, 1, 1)), 1e-3);
    checkModes(bodyOf(triangulate(test::rectangle({0, 0}, {1, 1}), .2)), 1e-4);
  }
}

TEST(Smoothed, ALoneTriangleIsALinearOne) {
  Model model =
      modelOf(test::oneTriangle({0, 0}, {.01, .001}, {.004, .008}), kSteel, ElementKind::kSmoothed);
  model.nodes.position = {{1e-4, 2e-4}, {.0101, .0012}, {.0038, .0083}};
  Model linear = model;
  linear.components[0].element = ElementKind::kLinear;
  const auto a = forcesOf(model);
  const auto b = forcesOf(linear);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_LT(norm(a[n] - b[n]), 1e-12 * norm(b[n]));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(stresses(model)[0][i], stresses(linear)[0][i], 1e-3);
  EXPECT_NEAR(strainEnergy(model, 0), strainEnergy(linear, 0), 1e-12 * strainEnergy(linear, 0));
}

TEST(Smoothed, EnergyOfPartsAddsUp) {
  Model model = smoothed(square(4));
  appendBlock(model, {.02, -.01}, {.03, .01}, 3, 3);
  shake(model, 10);
  const double dt = .5 * criticalTimeStep(model);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    model.nodes.position[n] += 1e-6 * model.nodes.velocity[n];
  double sum = 0;
  for (const Component& body : model.components) {
    std::vector<ElementId> all;
    for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e) all.emplace_back(e);
    sum += strainEnergy(model, dt, all);
  }
  EXPECT_NEAR(sum, strainEnergy(model, dt), 1e-12 * sum);
}

}  // namespace
}  // namespace yadefrag
