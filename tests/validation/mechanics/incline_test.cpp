// A block on an incline: gravity is turned instead of the plane. It settles at the angle under
// damping, at rest or at the slow speed at which damping balances it, and is then released without:
// in both cases the stresses before and after are the same, and nothing rings.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kGravity = 9.81;                // m/s²
constexpr double kFrictionAngle = 25 * kDegree;  // rad

/// A soft block, so that a wave crosses it in few steps per fall.
const ElasticMaterial kRubber{5e6, .3, 1000, false};

struct Slope {
  World world;
  ComponentId block;
  double dt;

  Slope(double angle, int passes, bool softGround = false) {
    const TriangleMesh ground = structuredRectangle({-.2, -.1}, {1, 0}, 36, 3);
    const TriangleMesh brick = structuredRectangle({0, 0}, {.2, .1}, 8, 4, QuadPattern::kCrossed);
    BodySpec below = moving(ground, kRubber, {}), above = moving(brick, kRubber, {});
    hold(below, ground, kHeldXY, [&](Vec2 x) { return !softGround || x.y < -.1 + 1e-9; });
    below.friction = above.friction = std::tan(kFrictionAngle);
    world.contactSettings.passes = passes;
    world.addBody(ground, below);
    block = world.addBody(brick, above);
    world.dynamicsSettings.gravity = {kGravity * std::sin(angle), -kGravity * std::cos(angle)};
    // An elastic block that slides with constant friction squeals: oscillations grow out of
    // rounding by e in some 7 ms, with any time step, until nodes lift off. This keeps them small.
    world.dynamicsSettings.viscosity.linear = .06;
    dt = .8 * world.criticalTimeStep();
  }
  [[nodiscard]] Vec2 velocity() const { return (1 / mass(world, block)) * momentum(world, block); }
  [[nodiscard]] double place() const {
    double sum = 0;
    const Nodes& nodes = world.model.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes.component[i] == block) sum += nodes.mass[i] * nodes.position[i].x;
    return sum / mass(world, block);
  }
  void runFor(double time) {
    const double until = world.time + time;
    while (world.time < until) world.step(dt);
  }
};

constexpr double kSettle = .3;  // s
constexpr double kQuiet =
    .05;  // s, before it squeals: in two passes a change of sides begins it with 1e-9
constexpr double kWatch = .5;  // s

void sticks(double angle, int passes, bool softGround = false) {
  Slope slope(angle, passes, softGround);
  slope.world.dynamicsSettings.damping = 2000;
  slope.runFor(kSettle);
  slope.world.dynamicsSettings.damping = 0;
  const double before = slope.place();
  const std::uint64_t steps = slope.world.steps;
  double farthest = 0;
  for (int i = 0; i < 30; ++i) {
    slope.runFor(kWatch / 30);
    farthest = std::max(farthest, std::abs(slope.place() - before));
  }
  const auto taken = static_cast<double>(slope.world.steps - steps);
  record("steps", taken);
  figure("creep_per_step", (slope.place() - before) / taken, 0, 1e-13);
  figure("farthest", farthest, 0, 1e-9);
}

void slides(double angle, int passes, bool softGround = false) {
  Slope slope(angle, passes, softGround);
  slope.world.dynamicsSettings.damping = 2000;
  slope.runFor(kSettle);
  slope.world.dynamicsSettings.damping = 0;
  const double along = kGravity * std::sin(angle);
  const double wanted = along - std::tan(kFrictionAngle) * kGravity * std::cos(angle);
  const double before = slope.velocity().x, start = slope.world.time;
  const auto error = [&] {
    return ((slope.velocity().x - before) / (slope.world.time - start) - wanted) / along;
  };
  slope.runFor(kQuiet);
  figure("early_error_over_g_sin", error(), 0, 1e-4);
  slope.runFor(kWatch - kQuiet);
  record("closed_form", wanted);
  figure("error_over_g_sin", error(), 0, .01);
}

TEST(Incline, SticksBelowTheFrictionAngle) { sticks(kFrictionAngle - 1.5 * kDegree, 1); }
TEST(Incline, SticksBelowTheFrictionAngleInTwoPasses) { sticks(kFrictionAngle - 1.5 * kDegree, 2); }
TEST(Incline, SticksFarBelowTheFrictionAngle) { sticks(10 * kDegree, 1); }
TEST(Incline, SlidesAboveTheFrictionAngle) { slides(kFrictionAngle + 10 * kDegree, 1); }
TEST(Incline, SlidesAboveTheFrictionAngleInTwoPasses) { slides(kFrictionAngle + 10 * kDegree, 2); }
TEST(Incline, SticksOnSoftGround) { sticks(kFrictionAngle - 1.5 * kDegree, 2, true); }
TEST(Incline, SlidesOnSoftGround) { slides(kFrictionAngle + 10 * kDegree, 2, true); }
TEST(Incline, SlidesOnASteepSlope) { slides(60 * kDegree, 1); }

}  // namespace
}  // namespace yadefrag::test
