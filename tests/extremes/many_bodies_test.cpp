// Many bodies in contact at once: a chain of 200, a wedge in a corner, a node between three bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "extremes/limits.hpp"
#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kSide = .01;  // m

// Newton's cradle of squares: as many leave at the far end as came in, one after the other, the
// rest is left at rest, none passes another. Without Poisson's ratio a wave in them is plane.
TEST(ExtremeChain, TwoHundredBodiesAtOnce) {
  constexpr int kSquares = 200, kStruck = 3;
  constexpr double kSpeed = 1;  // m/s
  World world = twoPasses();
  for (int k = 0; k < kSquares; ++k) {
    const Vec2 low{kSide * k, 0};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{kSide, kSide}, 2, 2, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, steel(0), {k < kStruck ? kSpeed : 0, 0});
    spec.selfContact = false;
    world.addBody(mesh, spec);
  }
  const double dt = .9 * world.criticalTimeStep();
  const double energy = world.kineticEnergy();
  const double impulse = mass(world, ComponentId(0UL)) * kStruck * kSpeed;
  const double wave = std::sqrt(steel(0).waveModulus() / steel(0).density);
  double drift = 0, lost = 0;
  while (world.time < 1.5 * kSquares * kSide / wave) {
    world.step(dt);
    drift = std::max(drift, std::abs(totalEnergy(world) / energy - 1));
  }
  std::vector<double> v;
  double disorder = 0;  // of the speed: how much faster a body is than the one ahead
  for (std::size_t k = 0; k < kSquares; ++k) {
    v.push_back(meanVelocity(world, ComponentId(k)).x);
    lost += mass(world, ComponentId(k)) * v[k];
    if (k > 0) disorder = std::max(disorder, (v[k - 1] - v[k]) / kSpeed);
  }
  double sent = 0;  // of the impulse, by the last four
  for (std::size_t k = v.size() - kStruck - 1; k < v.size(); ++k) sent += v[k] / kStruck / kSpeed;
  figure("energy_drift", drift, 0, 1e-6);
  figure("momentum_error", lost / impulse - 1, 0, 1e-12);
  figure("disorder", disorder, 0, .01);
  figure("sent_by_four", sent, 1, .06);
  // Each touch takes a part that shrinks with the mesh.
  figure("contact_energy", world.ledger.contact / energy, 0, .05);
  figure("deepest_in_segments", deepestNode(world) / world.search.shortest, 0, 1e-9);
  limit("bodies in contact in one chain, struck at its end", 1, kSquares, "not tried");
}

/// A wedge of this half angle (degrees) in a notch of 30 degrees to either side.
World wedgeInCorner(double halfAngle, double friction) {
  const double slope = std::tan(halfAngle * M_PI / 180), notch = std::tan(M_PI / 6);
  World world = twoPasses();
  const Polygon corner{{{-.02, -.01},
                        {.02, -.01},
                        {.02, .01},
                        {.01 * notch, .01},
                        {0, 0},
                        {-.01 * notch, .01},
                        {-.02, .01}},
                       {}};
  // A blunter one touches the notch's edges first.
  const double tip = std::max(0., .01 * (1 - notch / slope)) + 1e-4;
  const Polygon wedge{{{0, tip}, {.015 * slope, tip + .015}, {-.015 * slope, tip + .015}}, {}};
  const TriangleMesh below = triangulate(corner, .002), above = triangulate(wedge, .0015);
  BodySpec anvil = moving(below, rubber(), {0, 0}), driven = moving(above, rubber(), {0, -5});
  hold(anvil, below, kHeldXY, [](Vec2 at) { return at.y < -.01 + 1e-9; });
  anvil.friction = driven.friction = friction;
  world.addBody(below, anvil);
  world.addBody(above, driven);
  return world;
}

TEST(ExtremeCorner, AWedgeIsDrivenIn) {
  double deepest = 0;
  for (const double angle : {10., 29.9, 30., 30.1, 45.})
    for (const double friction : {0., .5, 100.}) {
      SCOPED_TRACE(angle);
      SCOPED_TRACE(friction);
      World world = wedgeInCorner(angle, friction);
      const RunResult result = watch(world, 800, 20);
      EXPECT_GT(result.touched, 100U);
      EXPECT_LT(result.deepest, .05);
      EXPECT_LT(result.growth, .02);
      EXPECT_LT(result.drift, .01);
      deepest = std::max(deepest, result.deepest);
    }
  record("deepest_in_segments", deepest);
  constexpr double kStated = 1.4e-4;  // depends on rounding
  EXPECT_NEAR(std::log(deepest), std::log(kStated), std::log(3.));
  limit("wedge driven into a corner of 60 degrees: deepest overlap, of a segment", kNone, kStated,
        "reduced slowly");
}

/// Three rhombs whose blunt corners meet at a point, in the middle of which there may be a light
/// triangle: each tip is between the two others, or on a face of the triangle.
World threeTips(double inner, double density) {
  World world = twoPasses();
  const auto at = [](double radius, double degrees) {
    const double angle = degrees * M_PI / 180;
    return radius * Vec2{std::cos(angle), std::sin(angle)};
  };
  for (int k = 0; k < 3; ++k) {
    const Vec2 tip = at(1e-5 + .55 * inner, 120. * k);
    const Polygon rhomb{
        {tip, tip + at(.01, 120. * k - 60), tip + at(.01, 120. * k), tip + at(.01, 120. * k + 60)},
        {}};
    const TriangleMesh mesh = triangulate(rhomb, .002);
    BodySpec spec = moving(mesh, rubber(), at(-1, 120. * k));
    spec.friction = .3;
    world.addBody(mesh, spec);
  }
  if (inner == 0) return world;
  const Polygon small{{at(inner, 60), at(inner, 180), at(inner, 300)}, {}};
  const TriangleMesh mesh = triangulate(small, inner);
  BodySpec spec = moving(mesh, {1e7, .3, density, false}, {0, 0});
  spec.friction = .3;
  world.addBody(mesh, spec);
  return world;
}

TEST(ExtremeCorner, ANodeIsPinchedBetweenThreeBodies) {
  for (const double inner : {0., 5e-4})
    for (const double density : {1e3, 1e1}) {
      SCOPED_TRACE(inner);
      SCOPED_TRACE(density);
      World world = threeTips(inner, density);
      const RunResult result = watch(world, 4000, 40);
      EXPECT_GT(result.touched, 100U);
      figure("deepest_in_segments", result.deepest, 0, 1e-3);
      figure("growth", result.growth, 0, 1e-3);
      figure("drift", result.drift, 0, .01);
      const Sums sums = sumsOf(world.model);
      EXPECT_LT(norm(sums.momentum) / sums.mass, 1e-12);
    }
}

// --- Friction from nothing to a hundred, strengths from next to nothing to next to infinite,
// cracks that take no energy.

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
    impulse += dt * contactForce(world, ComponentId(1UL));
  }
  return {meanVelocity(world, ComponentId(1UL)).x, -impulse.x / impulse.y};
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
  World world = twoPasses();
  for (int k = 0; k < 2; ++k) {
    const Vec2 low{.0101 * k, .002 * k};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 4 + k, 4, QuadPattern::kCrossed);
    BodySpec spec = brittle({1e9, .2, 1000, false}, strength, fractureEnergy);
    spec.velocity.assign(mesh.nodes.size(), {20. - 40 * k, 0});
    world.addBody(mesh, spec);
  }
  return world;
}

TEST(ExtremeStrength, WithoutBoundItIsElastic) {
  World strong = blocks(1e300, 0), elastic = blocks(0, 0);
  const double dt = .5 * strong.criticalTimeStep();  // the shorter of the two
  for (int i = 0; i < 300; ++i) strong.step(dt), elastic.step(dt);
  EXPECT_TRUE(sameBits(strong.model.nodes.position, elastic.model.nodes.position));
  EXPECT_TRUE(sameBits(strong.model.nodes.velocity, elastic.model.nodes.velocity));
}

TEST(ExtremeStrength, WithNoneEveryEdgeBreaksAndNothingIsLost) {
  World world = blocks(1e-300, 0);
  const Sums before = sumsOf(world.model);
  const auto edges = static_cast<double>(world.fracture.edges.size());
  stepFor(world, .5, 300);
  const Sums now = sumsOf(world.model);
  figure("mass_error", now.mass / before.mass - 1, 0, 1e-12);
  // The two bodies' momenta cancel: each is .002 kg m/s.
  figure("momentum", norm(now.momentum - before.momentum), 0, 1e-12);
  figure("cracked_edges", static_cast<double>(world.fracture.numCracks()) / edges, 1, 0);
  checkLaws(world.model, world.fracture.edges, world.surfaces);
  limit("tensile strength, Pa", 1e-300, 1e300, "refused: must be positive and finite");
}

TEST(ExtremeFractureEnergy, TooLittleIsRefused) {
  double least = INFINITY;
  for (double energy = 1e4; energy > 1e-9; energy /= 10) {
    World world = blocks(1e6, energy);
    const double dt = .5 * world.criticalTimeStep();
    const std::string sentence = sentenceOf([&] { world.step(dt); });
    if (!sentence.empty()) {
      EXPECT_TRUE(contains(sentence, "does not resolve"));
      continue;
    }
    EXPECT_LE(energy, least) << "refused above, but not here";
    least = energy;
  }
  limit("fracture energy, J/m² (1 MPa, elements of 2 mm, half the critical step)", least, kNone,
        "refused: a shorter step or smaller elements are needed; 0 opens at once");
}

}  // namespace
}  // namespace yadefrag::test
