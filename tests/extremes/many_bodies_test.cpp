// Many bodies in contact at once: a chain of 200, a wedge in a corner, a node between three bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "extremes/limits.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"
#include "step/run_result.hpp"

namespace yadefrag::test {
namespace {

constexpr double kSide = .01;  // m
const ElasticMaterial kSteel{210e9, 0, 7800, false};

/// Squares in a row that touch exactly; without Poisson's ratio a wave in them is plane.
World row(int squares, int parts, int struck, double speed) {
  World world;
  world.contactSettings.passes = 2;
  for (int k = 0; k < squares; ++k) {
    const Vec2 low{kSide * k, 0};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{kSide, kSide}, parts, parts, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, kSteel, {k < struck ? speed : 0, 0});
    spec.selfContact = false;
    world.addBody(mesh, spec);
  }
  return world;
}

std::vector<double> velocities(const World& world) {
  std::vector<double> found;
  for (std::size_t k = 0; k < world.model.components.size(); ++k)
    found.push_back(momentum(world, ComponentId(k)).x / mass(world, ComponentId(k)));
  return found;
}

// Newton's cradle of squares: as many leave at the far end as came in, one after the other, the
// rest is left at rest, none passes another.
TEST(ExtremeChain, TwoHundredBodiesAtOnce) {
  constexpr int kSquares = 200, kStruck = 3;
  constexpr double kSpeed = 1;  // m/s
  World world = row(kSquares, 2, kStruck, kSpeed);
  const double dt = .9 * world.criticalTimeStep();
  const double energy = world.kineticEnergy();
  const double impulse = mass(world, ComponentId(0UL)) * kStruck * kSpeed;
  const double wave = std::sqrt(kSteel.waveModulus() / kSteel.density);
  double drift = 0, lost = 0;
  while (world.time < 1.5 * kSquares * kSide / wave) {
    world.step(dt);
    drift = std::max(drift, std::abs(totalEnergy(world) / energy - 1));
  }
  const std::vector<double> v = velocities(world);
  double disorder = 0;  // of the speed: how much faster a body is than the one ahead
  for (std::size_t k = 0; k < v.size(); ++k) {
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
  World world;
  world.contactSettings.passes = 2;
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
  RunResult worst;
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
      worst.deepest = std::max(worst.deepest, result.deepest);
      worst.growth = std::max(worst.growth, result.growth);
      worst.drift = std::max(worst.drift, result.drift);
    }
  record("deepest_in_segments", worst.deepest), record("growth", worst.growth);
  record("drift", worst.drift);
  limit("wedge driven into a corner of 60 degrees: deepest overlap, of a segment", kNone,
        worst.deepest, "reduced slowly", 3);
}

/// Three rhombs whose blunt corners meet at a point, in the middle of which there may be a light
/// triangle: each tip is between the two others, or on a face of the triangle.
World threeTips(double inner, double density) {
  World world;
  world.contactSettings.passes = 2;
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
      Vec2 sum;
      double weight = 0;
      for (std::size_t c = 0; c < world.model.components.size(); ++c)
        sum += momentum(world, ComponentId(c)), weight += mass(world, ComponentId(c));
      EXPECT_LT(norm(sum) / weight, 1e-12);
    }
}

}  // namespace
}  // namespace yadefrag::test
