// Bodies of very different mass and stiffness touch.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "extremes/block_collision.hpp"

namespace yadefrag::test {
namespace {

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
  World world;
  world.contactSettings.passes = 2;
  ElasticMaterial light = rubber();
  light.density *= ratio;
  TriangleMesh small;
  small.nodes = {{-.2, 0}, {.2, 0}, {.02, .3}};
  small.triangles = {{0, 1, 2}};
  small.loops = {{0, 1, 2}};
  const double speed = .02 * waveSpeed(rubber());
  const TriangleMesh low = structuredRectangle({-.5, -1}, {.5, 0}, 2, 2);
  const TriangleMesh high = structuredRectangle({-.5, .3}, {.5, 1.3}, 3, 3);
  world.addBody(small, moving(small, light, {}));
  world.addBody(low, moving(low, rubber(), {0, speed}));
  world.addBody(high, moving(high, rubber(), {0, -speed}));
  const double energy = world.kineticEnergy();
  const double dt = .9 * world.criticalTimeStep(), end = 20 / waveSpeed(rubber());
  const int every = std::max(1, static_cast<int>(end / dt / 200));
  outcome.refusal = sentenceOf([&] {
    for (int i = 0; world.time < end; ++i) {
      world.step(dt);
      if (i % every != 0) continue;
      outcome.deepest = std::max(outcome.deepest, deepestNode(world) / .3);
      const double now = world.kineticEnergy() + world.strainEnergy();
      outcome.growth = std::max(outcome.growth, now / energy - 1);
    }
  });
  for (std::uint32_t c = 1; c < 3; ++c) {
    const ComponentId body(std::size_t{c});
    (c == 1 ? outcome.left : outcome.right) =
        (1 / speed / mass(world, body)) * momentum(world, body);
  }
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

}  // namespace
}  // namespace yadefrag::test
