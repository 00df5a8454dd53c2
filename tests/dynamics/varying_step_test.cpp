// Central differences with steps of varying length.

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/blocks.hpp"

namespace yadefrag {
namespace {

Stepper shaken(double velocity, double factor, const StepSettings& settings = {}) {
  Model model = square();
  shake(model, velocity);
  return runOf(std::move(model), factor, settings);
}

TEST(VaryingStep, EnergyJumpsByASecondOrderTerm) {
  Stepper run = shaken(1e-3, .9);
  run.step(100);
  const double before = run.total();
  run.dt *= .37;
  run.step();
  double squared = 0;  // f·M⁻¹f
  const auto forces = run.dynamics.internalForces();
  for (std::size_t n = 0; n < forces.size(); ++n)
    squared += dot(forces[n], forces[n]) / run.model.nodes.mass[n];
  const double dt = run.dt / .37;
  const double jump = (dt * dt - run.dt * run.dt) / 8 * squared;
  EXPECT_GT(jump, .01 * before);
  EXPECT_NEAR(run.total() - before, jump, 1e-4 * jump);
}

TEST(VaryingStep, FallsByTheClosedForm) {
  Stepper run = runOf(square(), .9, {.gravity = {0, -9.81}});
  const double dt = run.dt, start = run.model.nodes.position[0].y;
  double time = 0;
  for (int i = 0; i < 1000; ++i) {
    run.dt = dt * (.2 + .7 * (i * 7 % 11) / 11);
    time += run.dt;
    run.step();
  }
  // The velocity begins in the middle of the step before the first.
  const double fallen = 9.81 * time * (time + .2 * dt) / 2;
  EXPECT_NEAR(start - run.model.nodes.position[0].y, fallen, 1e-9 * fallen);
  EXPECT_NEAR(run.total(), 0, 1e-12 * run.ledger.external);
}

/// Spheres that push on a body get Δt f in a step, and the body gets as much.
TEST(VaryingStep, OuterForcesActForTheWholeStep) {
  Stepper run = runOf(square(), .9);
  std::vector<Vec2> outer(run.model.nodes.size());
  outer[3] = {5, -7};
  double time = 0;
  const double dt = run.dt;
  for (int i = 0; i < 300; ++i) {
    run.dt = i % 3 == 0 ? dt : .2 * dt;
    time += run.dt;
    run.step(1, outer);
  }
  Vec2 momentum;
  for (std::size_t n = 0; n < outer.size(); ++n)
    momentum += run.model.nodes.mass[n] * run.model.nodes.velocity[n];
  EXPECT_LT(norm(momentum - time * outer[3]), 1e-9 * norm(momentum));
  EXPECT_NEAR(run.total(), 0, .05 * run.ledger.external);
}

/// Factor by which energy grows in steps drawn between parts of the critical one.
double growth(double least, double most, int steps) {
  Stepper run = shaken(1e-3, 1);
  const double critical = run.dt;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(least, most);
  run.dt = most * critical;
  run.step();
  const double before = run.total();
  for (int i = 0; i < steps; ++i) {
    run.dt = part(random) * critical;
    run.step();
  }
  return run.total() / before;
}

/// With Δt in place of Δv the factors were 10³ and more.
TEST(VaryingStep, StepsBelowAThirdOfTheCriticalOneMayChange) {
  EXPECT_LT(growth(.05, .3, 10000), 1.2);
  EXPECT_LT(growth(.1, .5, 2000), 1.5);
}

TEST(VaryingStep, NearTheCriticalStepTheFastestModesResonate) {
  EXPECT_GT(growth(.27, .9, 3000), 10);
}

TEST(VaryingStep, ConstantStepsAreWhatTheyWere) {
  for (const double dt : {1e-9, .1, 1. / 3, 1e200}) {
    const StepLength length(dt, dt);
    EXPECT_EQ(length.position, dt);
    EXPECT_EQ(length.velocity, dt);
    EXPECT_EQ(StepLength(dt, 0).velocity, dt) << "the first step";
  }
}

}  // namespace
}  // namespace yadefrag
