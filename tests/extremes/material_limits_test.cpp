// Friction from nothing to a hundred, strengths from next to nothing to next to infinite, cracks
// that take no energy.

#include <gtest/gtest.h>

#include <cmath>

#include "core/same_bits.hpp"
#include "extremes/limits.hpp"
#include "fracture/random_cracks.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"
#include "step/run_result.hpp"

namespace yadefrag::test {
namespace {

constexpr double kGravity = 1e4;  // m/s², so that it takes few steps

/// A flat block that slides on the ground at 1 m/s.
World slider(double friction) {
  World world;
  const TriangleMesh ground = structuredRectangle({-.02, -.01}, {.06, 0}, 16, 2);
  const TriangleMesh block = structuredRectangle({0, 0}, {.03, .005}, 9, 2, QuadPattern::kCrossed);
  BodySpec below = moving(ground, steel(), {0, 0}), above = moving(block, steel(), {1, 0});
  hold(below, ground, kHeldXY, [](Vec2) { return true; });
  below.friction = above.friction = friction;
  world.addBody(ground, below);
  world.addBody(block, above);
  world.dynamicsSettings.gravity = {0, -kGravity};
  world.dynamicsSettings.viscosity.linear = .06;
  return world;
}

struct Slide {
  double speed;  ///< m/s, at the end
  double ratio;  ///< of the tangential impulse to the normal one
};

Slide slideFor(double friction, double time) {
  World world = slider(friction);
  const double dt = .8 * world.criticalTimeStep();
  Vec2 impulse;
  while (world.time < time) {
    world.step(dt);
    for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
      if (world.model.nodes.component[n] == ComponentId(1UL))
        impulse += dt * world.contact.forces()[n];
  }
  const double speed = momentum(world, ComponentId(1UL)).x / mass(world, ComponentId(1UL));
  return {speed, -impulse.x / impulse.y};
}

TEST(ExtremeFriction, FromNothingToAHundred) {
  constexpr double kTime = 5e-5;  // s, half of what brings it to rest at μ = 1
  figure("speed_at_0", slideFor(0, kTime).speed, 1, 1e-9);
  for (const double friction : {1e-3, .1, 1.}) {
    SCOPED_TRACE(friction);
    // A block that brakes hard hops a little.
    const Slide slide = slideFor(friction, kTime);
    figure("ratio", slide.ratio, friction, .02 * friction);
    figure("speed", slide.speed, 1 - friction * kGravity * kTime, .1 * friction);
  }
  for (const double friction : {1., 100.}) {
    SCOPED_TRACE(friction);
    figure("at_rest", slideFor(friction, 4 * kTime).speed, 0, .02);
  }
  EXPECT_FALSE(sentenceOf([] { (void)slider(INFINITY); }).empty());
  EXPECT_FALSE(sentenceOf([] { (void)slider(-.1); }).empty());
  limit("friction coefficient", 0, 100, "works the same; refused if negative or not finite");
}

/// Two blocks that meet at 20 m/s.
World blocks(double strength, double fractureEnergy) {
  World world;
  world.contactSettings.passes = 2;
  for (int k = 0; k < 2; ++k) {
    const Vec2 low{.0101 * k, .002 * k};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 4 + k, 4, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, {1e9, .2, 1000, false}, {20. - 40 * k, 0});
    spec.brittle.tensileStrength = strength;
    spec.brittle.fractureEnergy = fractureEnergy;
    world.addBody(mesh, spec);
  }
  return world;
}

Nodes after(World& world, int steps, double dt) {
  for (int i = 0; i < steps; ++i) world.step(dt);
  return world.model.nodes;
}

TEST(ExtremeStrength, WithoutBoundItIsElastic) {
  World strong = blocks(1e300, 0), elastic = blocks(0, 0);
  const double dt = .5 * strong.criticalTimeStep();  // the shorter of the two
  const Nodes a = after(strong, 300, dt), b = after(elastic, 300, dt);
  EXPECT_TRUE(sameBits(a.position, b.position));
  EXPECT_TRUE(sameBits(a.velocity, b.velocity));
}

TEST(ExtremeStrength, WithNoneEveryEdgeBreaksAndNothingIsLost) {
  World world = blocks(1e-300, 0);
  const Sums before = sumsOf(world.model);
  const auto edges = static_cast<double>(world.fracture.edges.size());
  (void)after(world, 300, .5 * world.criticalTimeStep());
  const Sums now = sumsOf(world.model);
  figure("mass_error", now.mass / before.mass - 1, 0, 1e-12);
  // The two bodies' momenta cancel: each is .002 kg m/s.
  figure("momentum", norm(now.momentum - before.momentum), 0, 1e-12);
  figure("cracked_edges", static_cast<double>(world.fracture.numCracks()) / edges, 1, 0);
  checkLaws(world.model, world.fracture.edges, world.surfaces);
}

TEST(ExtremeStrength, BeyondNumbersIsRefused) {
  for (const double strength : {double(INFINITY), double(NAN), -1.})
    EXPECT_FALSE(sentenceOf([&] { (void)blocks(strength, 0); }).empty()) << strength;
  for (const double energy : {double(INFINITY), double(NAN), -1.})
    EXPECT_FALSE(sentenceOf([&] { (void)blocks(1e6, energy); }).empty()) << energy;
  limit("tensile strength, Pa", 1e-300, 1e300, "refused: must be positive and finite");
}

TEST(ExtremeFractureEnergy, TooLittleIsRefusedAndNoneOpensAtOnce) {
  double least = INFINITY;
  for (double energy = 1e4; energy > 1e-9; energy /= 10) {
    World world = blocks(1e6, energy);
    const double dt = .5 * world.criticalTimeStep();
    const std::string sentence = sentenceOf([&] { world.step(dt); });
    if (!sentence.empty()) {
      EXPECT_NE(sentence.find("does not resolve"), std::string::npos) << sentence;
      continue;
    }
    EXPECT_LE(energy, least) << "refused above, but not here";
    least = energy;
  }
  World sudden = blocks(1e6, 0);
  (void)after(sudden, 300, .5 * sudden.criticalTimeStep());
  EXPECT_GT(sudden.fracture.numCracks(), 0U);
  EXPECT_EQ(sudden.ledger.fracture, 0);
  limit("fracture energy, J/m² (1 MPa, elements of 2 mm, half the critical step)", least, kNone,
        "refused: a shorter step or smaller elements are needed; 0 opens at once");
}

}  // namespace
}  // namespace yadefrag::test
