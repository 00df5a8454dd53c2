// Collisions of blocks of any size, in any step, of very different mass and stiffness.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "extremes/block_collision.hpp"

namespace yadefrag::test {
namespace {

// --- From nanometres to thousands of kilometres, near the origin and far from it, any way round.

constexpr double kAside = .1317;
const BlockCollision kUsual{.aside = kAside};

TEST(ExtremeSize, OutcomeIsTheSameButForRounding) {
  const Outcome usual = collide(kUsual);
  double least = kNone, most = kNone;
  for (const double size : {1e-30, 1e-15, 1e-9, 1e-3, 1e3, 1e6, 1e15, 1e30}) {
    const BlockCollision collision{.size = size, .aside = kAside};
    const Outcome outcome = collide(collision);
    EXPECT_TRUE(outcome.isSound()) << size << ": " << outcome.refusal;
    EXPECT_LE(difference(collision, outcome, kUsual, usual), 1e-13) << size;
    if (std::isnan(least)) least = size;
    most = size;
  }
  for (const double size : {1e-200, 1e-160, 1e155, 1e200})
    EXPECT_NE(collide({.size = size, .aside = kAside}).refusal, "") << size;
  // Any way round.
  for (const double turn : {1e-9, .1, 1., 1.5707963267948966, 2., 3., -2.}) {
    const BlockCollision collision{.aside = kAside, .turn = turn};
    EXPECT_LE(difference(collision, collide(collision), kUsual, usual), 1e-13) << turn;
  }
  limit("size of a body, m", least, most, "refused if masses exceed the range of numbers");
}

/// Rounding grows with the coordinates: 10⁻¹⁶ of them, ten times over the run.
TEST(ExtremeSize, ShiftsChangeRoundingOnly) {
  double most = kNone;
  for (const double size : {1., 1e-3}) {
    const BlockCollision near{.size = size, .aside = kAside};
    const Outcome usual = collide(near);
    for (const double ratio : {1e3, 1e6, 1e9, 1e11}) {
      BlockCollision collision = near;
      collision.shift = {ratio * size, -.3 * ratio * size};
      const Outcome outcome = collide(collision);
      EXPECT_TRUE(outcome.isSound()) << size << " " << ratio << ": " << outcome.refusal;
      EXPECT_LE(difference(collision, outcome, near, usual), 1e-14 * ratio) << size << " " << ratio;
      most = ratio;
    }
    BlockCollision collision = near;
    collision.shift = {1e12 * size, 0};
    EXPECT_NE(collide(collision).refusal, "") << size;
  }
  limit("distance from the origin, of a body's size", kNone, most,
        "refused when added: coordinates too coarse for its edges");
}

/// A millimetre block 1000 km from the origin.
TEST(ExtremeSize, SmallBodiesFarFromTheOrigin) {
  double least = kNone;
  for (const double speed : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1., 10.}) {
    const BlockCollision near{.speed = speed, .size = 1e-3, .gap = 1e-5, .aside = kAside};
    BlockCollision far = near;
    far.shift = {1e6, -1e6};
    const Outcome outcome = collide(far), usual = collide(near);
    if (speed < 1e-3) {
      EXPECT_TRUE(contains(outcome.refusal, "lost in rounding"));
      continue;
    }
    // Rounding adds up to 5 % to the slowest.
    EXPECT_TRUE(outcome.isSound(speed > 1e-3 ? 5e-3 : 5e-2)) << speed << ": " << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, usual.left.x, .01) << speed;
    EXPECT_LE(difference(far, outcome, near, usual), 1e-5) << speed;
    if (std::isnan(least)) least = speed;
  }
  limit("speed of a millimetre block 10⁶ m from the origin, m/s", least, kNone,
        "refused when added: its steps would be lost in rounding, which adds up to 5 % there");
}

// --- Bodies of very different mass and stiffness touch.

/// Blocks of one stiffness; the right one's density times `ratio`.
BlockCollision ofDensities(double ratio) {
  const double root = std::sqrt(ratio);
  BlockCollision collision{
      .gap = 1e-6 * std::min(1., root), .until = 6 * std::min(root, 1 / root), .parts = 2};
  collision.right.density *= ratio;
  return collision;
}

TEST(ExtremeRatio, OfMasses) {
  double least = kNone, most = kNone;
  for (const double ratio : {1e-16, 1e-12, 1e-8, 1e-4, 1., 1e4, 1e8, 1e12, 1e16}) {
    const Outcome outcome = collide(ofDensities(ratio));
    EXPECT_TRUE(outcome.isSound()) << ratio << ": " << outcome.refusal;
    // A heavy one goes on, a light one comes back, but for what the nodes that touch lose.
    if (ratio < 1e-3) {
      EXPECT_NEAR(outcome.left.x, 1, 2 * ratio + 1e-15) << ratio;
      EXPECT_NEAR(outcome.right.x, 1.704, .01) << ratio;
    }
    if (ratio > 1e3) {
      EXPECT_NEAR(outcome.left.x, -.629, .01) << ratio;
    }
    if (std::isnan(least)) least = ratio;
    most = ratio;
  }
  limit("mass over mass of two bodies that touch", least, most, "not tried");
}

TEST(ExtremeRatio, OfStiffnesses) {
  double least = kNone, most = kNone;
  for (const double ratio : {1e-8, 1e-4, 1., 1e4, 1e8}) {
    if (std::abs(std::log10(ratio)) > 7 && !longRun()) continue;
    BlockCollision collision{.gap = 1e-6, .parts = 1};
    collision.right.young *= ratio;
    collision.speed = .01 * std::min(waveSpeed(collision.left), waveSpeed(collision.right));
    const Outcome outcome = collide(collision);
    EXPECT_TRUE(outcome.isSound()) << ratio << ": " << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, .33, .07) << ratio;
    if (std::isnan(least)) least = ratio;
    most = ratio;
  }
  if (longRun())
    limit("stiffness over stiffness of two bodies that touch", least, most,
          "works, with as many steps as the stiffer one needs");
}

/// A triangle as light as a feather is between two heavy blocks that come together, and holds them
/// apart like a spring: its one node at the top touches, and the side below.
Outcome squeeze(double ratio) {
  Outcome outcome;
  World world = twoPasses();
  ElasticMaterial light = rubber();
  light.density *= ratio;
  const double speed = .02 * waveSpeed(rubber());
  addMoving(world, oneTriangle({-.2, 0}, {.2, 0}, {.02, .3}), light, {});
  addMoving(world, structuredRectangle({-.5, -1}, {.5, 0}, 2, 2), rubber(), {0, speed});
  addMoving(world, structuredRectangle({-.5, .3}, {.5, 1.3}, 3, 3), rubber(), {0, -speed});
  const TimedResult run = watchFor(world, 20 / waveSpeed(rubber()), .9, false);
  outcome.refusal = run.refusal;
  outcome.deepest = run.deepest / .3;
  outcome.growth = run.growth;
  outcome.left = (1 / speed) * meanVelocity(world, ComponentId(1UL));
  outcome.right = (1 / speed) * meanVelocity(world, ComponentId(2UL));
  return outcome;
}

TEST(ExtremeRatio, ALightNodeBetweenTwoHeavyBodies) {
  double least = kNone;
  for (const double ratio : {1., 1e-2, 1e-4, 1e-6, 1e-8}) {
    if (ratio < 1e-5 && !longRun()) continue;
    const Outcome outcome = squeeze(ratio);
    EXPECT_EQ(outcome.refusal, "") << ratio;
    EXPECT_LE(outcome.deepest, .01) << ratio;
    // The light one rattles: contact of its corners gains up to 0.8 % of the energy.
    EXPECT_LE(outcome.growth, ratio > 1e-5 ? 1e-3 : 1e-2) << ratio;
    EXPECT_LT(outcome.left.y, -.05) << ratio << ": thrown back";
    EXPECT_GT(outcome.right.y, .05) << ratio;
    least = ratio;
  }
  if (longRun())
    limit("density of a triangle between two heavy blocks, of theirs", least, kNone,
          "not tried; energy grows by up to 0.8 % there");
}

// --- From a thousandth of the critical time step to just above it; energy over very many steps.

TEST(ExtremeTimeStep, FromAThousandthOfTheCriticalOne) {
  const Outcome usual = collide({.ofCritical = .1});
  double least = kNone, most = kNone;
  for (const double part : {1e-4, 1e-3, 1e-2, .1, .5, .9, .99, 1.}) {
    if (part < 1e-3 && !longRun()) continue;
    const Outcome outcome = collide({.ofCritical = part});
    EXPECT_TRUE(outcome.isSound()) << part << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, usual.left.x, .004) << part;
    if (part == 1e-3) least = part;
    most = part;
  }
  const std::string beyond = collide({.ofCritical = 1.0001}).refusal;
  EXPECT_TRUE(contains(beyond, "must be above 0 and at most"));
  limit("time step, of the critical one", least, most,
        "below: works, down to 10⁻⁴ at least; above: refused, with the critical step");
}

/// Two squares between four held walls, with contact all the time: growth of kinetic and strain
/// energy, of the start's.
double growthOver(int steps, double ofCritical) {
  World world = twoPasses();
  const auto add = [&](Vec2 low, Vec2 high, int nx, int ny, Vec2 velocity, bool held) {
    const TriangleMesh mesh = structuredRectangle(low, high, nx, ny);
    BodySpec spec = moving(mesh, rubber(), velocity);
    if (held) hold(spec, mesh, kHeldXY, [](Vec2) { return true; });
    world.addBody(mesh, spec);
  };
  add({-.2, -.2}, {2.5, 0}, 4, 1, {}, true);
  add({-.2, 1.3}, {2.5, 1.5}, 4, 1, {}, true);
  add({-.2, 0}, {0, 1.3}, 1, 2, {}, true);
  add({2.3, 0}, {2.5, 1.3}, 1, 2, {}, true);
  add({.1, .1}, {1.1, 1.1}, 2, 2, {3, 2}, false);
  add({1.2, .15}, {2.2, 1.15}, 3, 3, {-4, 1}, false);
  const double dt = ofCritical * world.criticalTimeStep();
  const double start = world.kineticEnergy();
  double most = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    if (i % 100 == 0)
      most = std::max(most, (world.kineticEnergy() + world.strainEnergy()) / start - 1);
  }
  return most;
}

TEST(ExtremeTimeStep, EnergyDoesNotGrow) {
  const int steps = longRun() ? 1'000'000 : 20'000;
  for (const double ofCritical : {.9, 1.}) EXPECT_LE(growthOver(steps, ofCritical), 1e-3);
  if (longRun())
    limit("steps over which energy grows by less than 10⁻³", kNone, steps, "not tried");
}

}  // namespace
}  // namespace yadefrag::test
