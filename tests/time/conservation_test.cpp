// Momentum and the energy ledger.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "elements/blocks.hpp"

namespace yadefrag {
namespace {

Stepper shaken(double velocity, double factor, const StepSettings& settings = {}) {
  Model model = square();
  shake(model, velocity);
  return runOf(std::move(model), factor, settings);
}

TEST(Conservation, MomentumIsKeptToRounding) {
  for (Model model : {square(), smoothed(square())}) {
    shake(model, 50);
    Stepper run = runOf(std::move(model), .8);
    const test::Moments before = test::momentsOf(run.model.nodes);
    run.step(2000);
    const test::Moments after = test::momentsOf(run.model.nodes);
    const double scale = 50 * kSteel.density * 4e-4;  // velocity × mass
    EXPECT_LT(norm(after.linear - before.linear), 1e-12 * scale);
    EXPECT_NEAR(after.angular, before.angular, 1e-12 * scale * .01);
    EXPECT_EQ(run.ledger.total(0, 0), 0) << "nothing is counted where nothing acts";
  }
}

/// Largest deviation of the total energy over a fixed time, relative to it.
double energyError(Model model, double velocity, double dt, double time) {
  shake(model, velocity);
  Stepper run{.model = std::move(model), .dt = dt};
  run.start();
  // Velocities of all runs belong to the same moment: half a step back from the shape at rest,
  // where no force acts.
  const double energy = run.total();
  double worst = 0;
  for (double t = 0; t < time; t += dt) {
    run.step();
    worst = std::max(worst, std::abs(run.total() - energy));
  }
  return worst / energy;
}

TEST(Conservation, EnergyOfSmallVibrationIsConstantToRoundingAtAnyStableStep) {
  for (const Model& model : {square(4), smoothed(square(4))}) {
    const double dt = criticalTimeStep(model);
    // v/c = 2·10⁻⁷ is what geometry is not linear by. ½(W + W') would be off by a half.
    EXPECT_LT(energyError(model, 1e-3, .99 * dt, 500 * dt), 1e-6);
  }
}

TEST(Smoothed, EnergyIsConstantOver100000Steps) {
  const Model model = smoothed(square(4));
  const double dt = criticalTimeStep(model);
  EXPECT_LT(energyError(model, 1e-3, .99 * dt, 100000 * dt), 2e-6);
}

TEST(Conservation, EnergyErrorOfLargeVibrationFallsWithTheSquareOfTheStep) {
  for (const Model& model : {square(4), smoothed(square(4))}) {
    const double dt = criticalTimeStep(model);
    const double coarse = energyError(model, 60, .5 * dt, 400 * dt);
    const double fine = energyError(model, 60, .25 * dt, 400 * dt);
    EXPECT_LT(coarse, 1e-2);
    EXPECT_GT(coarse / fine, 3);
  }
}

TEST(Conservation, DampingDissipatesWhatTheMotionLoses) {
  Stepper run = shaken(1, .9, {.damping = 2e5});
  const double energy = run.total();
  run.step(3000);
  EXPECT_LT(run.kinetic() + run.strain(), 1e-3 * energy);
  EXPECT_NEAR(run.ledger.damping, energy, 2e-3 * energy);
  EXPECT_NEAR(run.total(), energy, 1e-6 * energy);  // v/c of geometry
}

TEST(Conservation, LoadsAndOuterForcesAreExternalWork) {
  Model model = square();
  std::vector<Vec2> outer(model.nodes.size());
  outer[1] = {0, 4e3};
  model.nodes.load.resize(model.nodes.size());
  model.nodes.load[0] = {1e3, -2e3};
  Stepper run = runOf(std::move(model), .9);
  run.step(1000, outer);
  EXPECT_GT(run.ledger.external, 0);
  EXPECT_NEAR(run.total(), 0, 1e-4 * run.ledger.external);
}

/// A bar, held on the left, pulled at a constant velocity on the right.
Stepper pulledBar(double velocity, const StepSettings& settings) {
  Model model;
  appendBlock(model, {0, 0}, {.1, .01}, 20, 2);
  Nodes& nodes = model.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes.position[n].x == 0) nodes.held[n] = kHeldXY;
    if (nodes.position[n].x == .1) {
      nodes.held[n] = kHeldX;
      nodes.velocity[n] = {velocity, 0};
    }
  }
  return runOf(std::move(model), .8, settings);
}

TEST(Conservation, PrescribedMotionIsExternalWork) {
  Stepper run = pulledBar(.5, {.damping = 2e3, .gravity = {0, -9.81}});
  const double energy = run.total();
  run.step(2000);
  EXPECT_NEAR(run.total(), energy, 1e-5 * run.ledger.external);
  // Close to the work of static stretching: E' A ε²/2 L with E' of plane strain.
  const double strain = .5 * run.dt * 2000 / .1;
  const double work = kSteel.young / (1 - .09) * .01 * strain * strain / 2 * .1;
  EXPECT_NEAR(run.ledger.external, work, .2 * work);
  for (std::size_t n = 0; n < run.model.nodes.size(); ++n) {
    const std::uint8_t held = run.model.nodes.held[n];
    if (held == kHeldXY) {
      EXPECT_EQ(run.model.nodes.velocity[n], Vec2{});
    }
    if (held == kHeldX) {
      EXPECT_EQ(run.model.nodes.velocity[n].x, .5);
    }
  }
}

TEST(Conservation, AChangeOfThePrescribedMotionIsExternalWorkToo) {
  Stepper run = pulledBar(0, {});
  for (int i = 0; i < 1000; ++i) {
    for (std::size_t n = 0; n < run.model.nodes.size(); ++n)
      if (run.model.nodes.held[n] == kHeldX) run.model.nodes.velocity[n].x = 5e-4 * i;
    run.step();
    // 10⁻⁶: rounding of the stress in the first steps.
    EXPECT_NEAR(run.total(), 0, 1e-6 + 1e-4 * run.ledger.external);
  }
  EXPECT_GT(run.ledger.external, 1e-3);
}

TEST(Conservation, ReactionsToContactForcesAreExternalWork) {
  Model model = square();
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    model.nodes.held[n] = kHeldXY;
    model.nodes.velocity[n] = {3, 0};
  }
  std::vector<Vec2> contact(model.nodes.size());
  contact[2] = {-100, 50};
  Stepper run = runOf(std::move(model), .8);
  run.dynamics.predict(run.model, run.dt, {}, {}, 1);
  run.dynamics.finish(run.model, run.dt, {}, {}, contact, run.ledger);
  EXPECT_NEAR(run.ledger.external, 300 * run.dt, 1e-3 * run.dt);
}

TEST(Conservation, BulkViscosityDissipatesEnergyAndCountsIt) {
  Stepper run = shaken(5, .9, {.viscosity = {.1, 1.2}});
  const double energy = run.total();
  double before = 0;
  for (int i = 0; i < 400; ++i) {
    run.step();
    EXPECT_GE(run.ledger.damping, before - 1e-3 * energy);  // within a step v̄ and vⁿ⁻½ differ
    before = run.ledger.damping;
  }
  EXPECT_GT(run.ledger.damping, .1 * energy);
  EXPECT_NEAR(run.total(), energy, 1e-4 * energy);
}

// --- Central differences with steps of varying length.

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
  for (const bool varies : {false, true}) {
    Stepper run = runOf(square(), .9, {.gravity = {2, -9.81}});
    const double dt = run.dt, first = varies ? .2 * dt : dt, start = run.model.nodes.position[0].y;
    double time = 0;
    for (int i = 0; i < 1000; ++i) {
      if (varies) run.dt = dt * (.2 + .7 * (i * 7 % 11) / 11);
      time += run.dt;
      run.step();
    }
    // The velocity begins in the middle of the step before the first, and is that of the middle of
    // the last.
    const double falling = time + (first - run.dt) / 2, fallen = 9.81 * time * (time + first) / 2;
    EXPECT_NEAR(run.model.nodes.velocity[3].y, -9.81 * falling, 1e-9);  // rounding of stress
    EXPECT_NEAR(start - run.model.nodes.position[0].y, fallen, 1e-9 * fallen);
    const double energy = kSteel.density * 4e-4 * (4 + 9.81 * 9.81) * falling * falling / 2;
    EXPECT_NEAR(run.ledger.external, energy, 1e-12 * energy);
    EXPECT_NEAR(run.total(), 0, 1e-12 * energy);
  }
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
  const Vec2 momentum = test::momentsOf(run.model.nodes).linear;
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
