// Bodies with smoothed strains: modes without energy, energy and momentum, dropped triangles.
#include <gtest/gtest.h>
#include <algorithm>

#include <Eigen/Dense>
#include <cmath>

#include "core/same_bits.hpp"
#include "dynamics/blocks.hpp"
#include "dynamics/element_state.hpp"
#include "dynamics/spin.hpp"
#include "meshing/triangulate.hpp"

namespace yadefrag {
namespace {

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

Model bodyOf(const TriangleMesh& mesh, const ElasticMaterial& material) {
  Model model;
  Component component;
  component.material = material;
  component.element = ElementKind::kSmoothed;
  appendBody(model, mesh, component);
  return model;
}

TEST(Smoothed, NoMotionButTheRigidOnesIsWithoutEnergy) {
  for (const double poisson : {0., .3, .49}) {
    const ElasticMaterial material{.young = 1, .poisson = poisson, .density = 1};
    for (const QuadPattern pattern : {QuadPattern::kUnionJack, QuadPattern::kCrossed})
      checkModes(bodyOf(structuredRectangle({0, 0}, {1, 1}, 4, 4, pattern), material), 1e-3);
    checkModes(bodyOf(structuredRectangle({0, 0}, {1, 1}, 1, 1), material), 1e-3);
    checkModes(bodyOf(triangulate({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}, .2), material), 1e-4);
  }
}

TEST(Smoothed, ALoneTriangleIsALinearOne) {
  TriangleMesh mesh;
  mesh.nodes = {{0, 0}, {.01, .001}, {.004, .008}};
  mesh.triangles = {{0, 1, 2}};
  Model model = bodyOf(mesh, kSteel);
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

/// Largest deviation of the energy over some steps, relative to it.
double energyError(double velocity, double factor, int steps) {
  Model model = smoothed(square(4));
  shake(model, velocity);
  Stepper run = runOf(std::move(model), factor);
  const double energy = run.total();
  double worst = 0;
  for (int i = 0; i < steps; i += 10) {
    run.step(10);
    worst = std::max(worst, std::abs(run.total() - energy));
  }
  return worst / energy;
}

TEST(Smoothed, EnergyIsConstantOver100000Steps) {
  // v/c = 2·10⁻⁷ is what geometry is not linear by.
  EXPECT_LT(energyError(1e-3, .99, 100000), 2e-6);
}

TEST(Smoothed, EnergyErrorOfLargeVibrationFallsWithTheSquareOfTheStep) {
  const double coarse = energyError(60, .5, 400);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GT(coarse / energyError(60, .25, 800), 3);
}

TEST(Smoothed, MomentumIsKeptToRounding) {
  Model model = smoothed(square());
  shake(model, 50);
  Stepper run = runOf(std::move(model), .8);
  const auto momentum = [&] {
    Vec2 linear;
    double angular = 0;
    const Nodes& nodes = run.model.nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      linear += nodes.mass[n] * nodes.velocity[n];
      angular += nodes.mass[n] * cross(nodes.position[n], nodes.velocity[n]);
    }
    return std::pair{linear, angular};
  };
  const auto [linear, angular] = momentum();
  run.step(2000);
  const auto [laterLinear, laterAngular] = momentum();
  const double scale = 50 * kSteel.density * 4e-4;  // velocity × mass
  EXPECT_LT(norm(laterLinear - linear), 1e-12 * scale);
  EXPECT_NEAR(laterAngular, angular, 1e-12 * scale * .01);
}

TEST(Smoothed, SpinShowsNoFalseStress) {
  expectNoFalseStressIn(smoothed(square()), 1e4, [](double /*dt*/) { return 3000; });
}

TEST(Smoothed, TheSameBitsWithAnyThreadsAndInstructionSet) {
  const auto runWith = [](int threads, InstructionSet set) {
    Model model = smoothed(square(64));
    appendBlock(model, {.02, -.01}, {.03, .01}, 20, 30);  // linear
    shake(model, 50);
    Stepper run{.model = std::move(model), .dt = 0, .threads = threads, .set = set};
    run.dt = .8 * criticalTimeStep(run.model);
    run.start();
    run.step(50);
    return run.model.nodes;
  };
  const Nodes one = runWith(1, bestInstructionSet());
  for (const int threads : {2, 3})
    EXPECT_TRUE(test::sameBits(one.position, runWith(threads, bestInstructionSet()).position));
  EXPECT_TRUE(test::sameBits(one.velocity, runWith(1, InstructionSet::kBaseline).velocity));
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
  double elements = 0;
  for (const double energy : elementEnergies(model)) elements += energy;
  EXPECT_NEAR(elements, strainEnergy(model, 0), 1e-12 * elements);
}

}  // namespace
}  // namespace yadefrag
