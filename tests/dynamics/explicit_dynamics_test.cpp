// Waves, errors, and the same bits everywhere.
#include "dynamics/explicit_dynamics.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/same_bits.hpp"
#include "dynamics/blocks.hpp"

namespace yadefrag {
namespace {

/// A slender bar along x without lateral strain: its axial waves run at √(E/ρ).
Model bar(double length, int quads) {
  ElasticMaterial material = kSteel;
  material.poisson = 0;
  Model model;
  appendBlock(model, {0, 0}, {length, 2 * length / quads}, quads, 2, material);
  return model;
}

const double kBarSpeed = std::sqrt(kSteel.young / kSteel.density);

TEST(ExplicitDynamics, LowestAxialFrequencyOfABar) {
  const double length = .1;
  Model model = bar(length, 60);
  std::vector<double> shape;
  for (const Vec2 x : model.nodes.position)
    shape.push_back(std::cos(std::numbers::pi * x.x / length));
  for (std::size_t n = 0; n < shape.size(); ++n) model.nodes.velocity[n] = {1e-3 * shape[n], 0};
  Stepper run = runOf(std::move(model), .9);
  const auto amplitude = [&] {
    double sum = 0;
    for (std::size_t n = 0; n < shape.size(); ++n)
      sum += run.model.nodes.mass[n] * shape[n] * run.model.nodes.velocity[n].x;
    return sum;
  };
  // The tenth change of sign comes after 9½ half periods L/c. Velocities are those half a step
  // back.
  double now = amplitude();
  double time = -run.dt / 2;
  for (int changes = 0; changes < 10; time += run.dt) {
    const double before = now;
    run.step();
    now = amplitude();
    if (now * before < 0 && ++changes == 10) time -= run.dt * now / (now - before);
  }
  // Linear elements, 60 of them: (πh/L)²/24 = 10⁻⁴; some more on a mesh that is not regular.
  EXPECT_NEAR(time / (9.5 * length / kBarSpeed), 1, 1e-3);
}

TEST(ExplicitDynamics, AStepOfVelocityRunsAtTheWaveSpeed) {
  const double length = .1;
  Model model = bar(length, 200);
  std::size_t middle = 0;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    if (x.x == 0) {
      model.nodes.held[n] = kHeldX;
      model.nodes.velocity[n] = {1, 0};
    }
    if (x.y == 0 && std::abs(x.x - length / 2) < 1e-6) middle = n;
  }
  Stepper run = runOf(std::move(model), .9);
  double time = 0;
  // A front that spreads by dispersion has a third of its height where it would be without.
  for (; run.model.nodes.velocity[middle].x < 1. / 3; time += run.dt) run.step();
  EXPECT_NEAR(time * kBarSpeed / (length / 2), 1, .005);  // half an element
}

std::string errorOf(Stepper& run, std::span<const Vec2> outer = {}) {
  try {
    run.step(1, outer);
  } catch (const RunError& error) {
    return error.what();
  }
  return "none";
}

TEST(ExplicitDynamics, AStepThatTurnsAnElementInsideOutIsTakenBack) {
  Stepper run = runOf(square(), .8);
  run.step();
  run.model.nodes.velocity[40] = {.004 / run.dt, 0};  // across its neighbours
  const Nodes before = run.model.nodes;
  run.step();
  std::string message;
  try {
    run.dynamics.requireUpright(run.model, run.dt, 0);
  } catch (const RunError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("of component 0 at ("), std::string::npos) << message;
  EXPECT_NE(message.find(" is inverted in a step of"), std::string::npos) << message;
  run.dynamics.takeBack(run.model);
  EXPECT_TRUE(test::sameBits(run.model.nodes.position, before.position));
  EXPECT_TRUE(test::sameBits(run.model.nodes.velocity, before.velocity));
}

TEST(ExplicitDynamics, AnInvertedElementStopsTheRun) {
  Stepper run = runOf(square(), .8);
  run.model.nodes.position[40].x += .004;
  const Nodes before = run.model.nodes;
  const std::string message = errorOf(run);
  EXPECT_NE(message.find("of component 0 at ("), std::string::npos) << message;
  EXPECT_NE(message.find("is inverted."), std::string::npos) << message;
  EXPECT_TRUE(test::sameBits(run.model.nodes.position, before.position));
  EXPECT_TRUE(test::sameBits(run.model.nodes.velocity, before.velocity));
}

TEST(ExplicitDynamics, APositionThatIsNotANumberStopsTheRun) {
  Stepper run = runOf(square(), .8);
  run.model.nodes.position[7].y = std::numeric_limits<double>::quiet_NaN();
  const std::string message = errorOf(run);
  EXPECT_NE(message.find("has a value that is not finite."), std::string::npos) << message;
}

TEST(ExplicitDynamics, AForceThatIsNotANumberChangesNothing) {
  Model model = square();
  shake(model, 3);
  Stepper run = runOf(std::move(model), .8);
  run.step(3);
  const Nodes before = run.model.nodes;
  std::vector<Vec2> outer(before.size());
  outer[7].x = std::numeric_limits<double>::infinity();
  const std::string message = errorOf(run, outer);
  EXPECT_NE(message.find("node 7 of component 0 at ("), std::string::npos) << message;
  EXPECT_TRUE(test::sameBits(run.model.nodes.velocity, before.velocity));
  EXPECT_TRUE(test::sameBits(run.model.nodes.position, before.position));
}

/// Positions and velocities of a scene of several materials, after some steps with everything on.
std::vector<Vec2> stateAfterSteps(int threads, InstructionSet set) {
  Model model = square(70);
  ElasticMaterial soft = kSteel;
  soft.young /= 7;
  appendBlock(model, {.02, 0}, {.03, .03}, 30, 31, soft);
  appendBlock(model, {.04, 0}, {.05, .03}, 3, 5, soft);
  shake(model, 5);
  Stepper run{.model = std::move(model),
              .dt = 1e-8,
              .settings = {.damping = 10, .gravity = {0, -9.81}, .viscosity = {.06, 1.2}},
              .threads = threads,
              .set = set};
  run.start();
  run.step(20);
  std::vector<Vec2> state = run.model.nodes.position;
  state.insert(state.end(), run.model.nodes.velocity.begin(), run.model.nodes.velocity.end());
  state.push_back({run.ledger.external, run.ledger.damping});
  return state;
}

TEST(ExplicitDynamics, TheSameBitsWithAnyNumberOfThreads) {
  const std::vector<Vec2> one = stateAfterSteps(1, bestInstructionSet());
  EXPECT_EQ(stateAfterSteps(2, bestInstructionSet()), one);
  EXPECT_EQ(stateAfterSteps(3, bestInstructionSet()), one);
}

TEST(ExplicitDynamics, TheSameBitsWithAnyInstructionSet) {
  const std::vector<Vec2> baseline = stateAfterSteps(1, InstructionSet::kBaseline);
  const InstructionSet best = bestInstructionSet();
  if (best >= InstructionSet::kAvx2) {
    EXPECT_EQ(stateAfterSteps(1, InstructionSet::kAvx2), baseline);
  }
}

TEST(ExplicitDynamics, BodiesDoNotAffectEachOther) {
  Model both = square(20);
  appendBlock(both, {.1, .1}, {.12, .12}, 20, 20);
  shake(both, 5);
  Stepper alone = runOf(square(20), .5);
  std::copy_n(both.nodes.velocity.begin(), alone.model.nodes.size(),
              alone.model.nodes.velocity.begin());
  Stepper run{.model = both, .dt = alone.dt};
  run.start();
  run.step(50);
  alone.step(50);
  for (std::size_t n = 0; n < alone.model.nodes.size(); ++n) {
    // Chunks are cut elsewhere, so that sums may be in another order.
    EXPECT_LT(norm(run.model.nodes.position[n] - alone.model.nodes.position[n]), 1e-15);
  }
}

TEST(ExplicitDynamics, NoElementsNoSteps) {
  Stepper run{.model = {}, .dt = 1};
  run.start();
  run.step(2);
  EXPECT_EQ(run.total(), 0);
}

}  // namespace
}  // namespace yadefrag
