// The motion of bodies that were bonded along sides that did not match node by node.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/checks.hpp"
#include "fracture/laboratory.hpp"
#include "fracture/random_cracks.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

// --- a wave

/// (m/s) At a place along a bar: a pulse of 1 m/s between x = .05 and .15 m.
double pulse(double x) {
  return .5 * (1 - std::cos(2 * M_PI * std::clamp((x - .05) / .1, 0., 1.)));
}

/// Largest error of the velocity (of the pulse's 1 m/s) after the pulse has run 0.2 m in a bar of
/// bonded parts, at the speed of sound c; the exact one is the pulse, shifted.
double pulseErrorIn(const std::vector<TriangleMesh>& parts) {
  constexpr double dt = 1e-7;
  World world;
  const double c = std::sqrt(kMaterial.young / kMaterial.density);
  for (const TriangleMesh& mesh : parts) {
    BodySpec spec = resting(mesh);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const double s = std::clamp((mesh.nodes[n].x - .05) / .1, 0., 1.);
      spec.velocity[n].x = pulse(mesh.nodes[n].x);
      const double passed = s - std::sin(2 * M_PI * s) / (2 * M_PI);
      spec.displacement.push_back({.1 / (2 * c) * (1 - passed), 0});
    }
    world.addBody(mesh, spec);
  }
  for (std::size_t i = 1; i < parts.size(); ++i)
    world.bond(ComponentId(i - 1), ComponentId(i), 1e9, 1e6);
  while (world.time < .2 / c) world.step(dt);
  const double run = c * (world.time - dt / 2);
  double worst = 0;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    worst = std::max(worst, std::abs(world.model.nodes.velocity[n].x -
                                     pulse(world.model.nodes.reference[n].x - run)));
  return worst;
}

TEST(ConformMotion, ABarOfTwoElementSizesCarriesAWaveAsOneBarDoes) {
  const double coarse = pulseErrorIn({barFrom(0, .4, 4)});
  record("coarse", coarse);
  for (const int rows : {4, 5, 6, 7, 10}) {
    const double bonded =
        pulseErrorIn({barFrom(0, .1, 4), barFrom(.1, .2, rows), barFrom(.2, .4, 4)});
    record("rows_" + std::to_string(rows), bonded);
    EXPECT_LT(bonded, 1.2 * coarse) << rows;
  }
}

// --- strength and energy

/// A bar of two parts, pulled apart slowly at `angle`.
struct Pull {
  double most = 0;    // of the strength, mean traction
  double spent = 0;   // of energy times area
  double excess = 0;  // of the spent energy, in the books
  std::size_t held = 0;
};

Pull pullApart(int rowsLeft, int rowsRight, double angle, bool canCrack = false) {
  const double strength = 2e6, energy = 20;
  TriangleMesh left = barFrom(0, .04, rowsLeft), right = barFrom(.04, .08, rowsRight);
  World world;
  const Vec2 along{std::cos(angle), std::sin(angle)};
  for (TriangleMesh* mesh : {&left, &right}) {
    BodySpec spec = resting(*mesh);
    hold(spec, *mesh, kHeldXY, [](Vec2 at) { return at.x < 1e-9 || at.x > .08 - 1e-9; });
    for (std::size_t n = 0; n < mesh->nodes.size(); ++n) {
      const Vec2 at = mesh->nodes[n];
      spec.velocity[n] = (.05 * (at.x - .04) / .04) * along;
      mesh->nodes[n] = at.x * along + at.y * Vec2{-along.y, along.x};
    }
    if (canCrack) {
      spec.brittle.tensileStrength = 20 * strength;
      spec.brittle.fractureEnergy = 500 * energy;
    }
    world.addBody(*mesh, spec);
  }
  const std::size_t sides = world.bond(kFirst, kSecond, strength, energy);
  EXPECT_EQ(sides == 4, rowsLeft == rowsRight);
  EXPECT_NEAR(bondedLength(world) / kHeight, 1, 1e-12);
  world.dynamicsSettings.damping = 2e4;
  const double dt = .4 * world.criticalTimeStep();
  Pull pull;
  const double start = totalEnergy(world);
  while (world.time < 2e-3 && !world.fracture.cohesion.edge.empty()) {
    world.step(dt);
    const Cohesion& cohesion = world.fracture.cohesion;
    double sum = 0;
    for (std::size_t i = 0; i < cohesion.edge.size(); ++i)
      for (const Vec2 one : cohesion.traction[i]) sum += one.x * cohesion.area[i];
    pull.most = std::max(pull.most, sum / (strength * kHeight));
  }
  const double whole = energy * kHeight;
  pull.spent = world.ledger.fracture / whole;
  pull.excess = (totalEnergy(world) - start) / whole;
  pull.held = world.fracture.cohesion.edge.size();
  EXPECT_EQ(world.fracture.numCracks(), 0U);
  return pull;
}

// The law's bound, and its area to what steps make of it (mode_one_test.cpp).
TEST(ConformMotion, AnInterfaceFailsAtItsStrengthAndTakesItsEnergy) {
  for (const auto& [left, right, angle, canCrack] : {std::tuple{4, 4, 0., false},
                                                     {4, 4, 0., true},
                                                     {4, 7, 0., false},
                                                     {7, 4, 0., false},
                                                     {3, 4, .3, false},
                                                     {2, 10, 2., false}}) {
    const Pull pull = pullApart(left, right, angle, canCrack);
    EXPECT_NEAR(pull.most, 1, left == right ? 1e-6 : 2e-3) << left << ' ' << right;
    EXPECT_NEAR(pull.spent, 1, 1e-3) << left << ' ' << right;
    EXPECT_NEAR(pull.excess, 0, .01) << left << ' ' << right;
    EXPECT_EQ(pull.held, 0U);
  }
}

// --- masonry

TEST(ConformMotion, BondedMasonryKeepsMomentumSpinAndEnergy) {
  World world = tJunction(.37, .6, .0075);
  world.bondAll(1e-6, 1e6, 20);
  const double dt = .5 * world.criticalTimeStep();
  world.step(dt);
  const double mass = sumsOf(world.model).mass, spin = momentsOf(world.model.nodes).angular,
               energy = totalEnergy(world);
  const Vec2 momentum = sumsOf(world.model).momentum;
  const std::size_t sides = world.fracture.cohesion.edge.size();
  for (int i = 0; i < 1000; ++i) world.step(dt);
  EXPECT_EQ(world.fracture.cohesion.edge.size(), sides);
  EXPECT_NEAR(norm(sumsOf(world.model).momentum - momentum), 0, 1e-13 * mass);
  figure("spin", momentsOf(world.model.nodes).angular / spin, 1, 1e-12);
  figure("energy", totalEnergy(world) / energy, 1, 1e-3);
}

TEST(ConformMotion, BondsOfDividedSidesBreakAndTheFacesTouch) {
  World world = tJunction(.45, 0, .0075, false);
  world.bondAll(1e-6, 5e5, 5);
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == kThird) world.model.nodes.velocity[n] = {2, 20};
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 300; ++i) world.step(dt);
  EXPECT_GT(momentum(world, kThird).y, 0);
  // Back onto the two: contact on sides that have been divided.
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == kThird) world.model.nodes.velocity[n].y = -20;
  const double start = totalEnergy(world);
  double deepest = 0;
  for (int i = 0; i < 2500; ++i) {
    world.step(dt);
    deepest = std::max(deepest, world.contact.maxPenetration());
  }
  EXPECT_GT(world.numSearches(), 0U);
  EXPECT_GT(momentum(world, kFirst).y + momentum(world, kThird).y, -20 * mass(world, kThird));
  EXPECT_NE(momentum(world, kSecond).y, 0);
  EXPECT_LT(deepest, 1e-4);
  EXPECT_NEAR(totalEnergy(world) / start, 1, .02);
}

TEST(ConformMotion, SmoothedElementsAndBodiesThatMoveAreBondedToo) {
  World world;
  const TriangleMesh left = barFrom(0, .04, 2), right = barFrom(.04, .08, 5);
  for (const TriangleMesh* mesh : {&left, &right}) {
    BodySpec spec = moving(*mesh, kMaterial, {1, 0});
    spec.element = ElementKind::kSmoothed;
    world.addBody(*mesh, spec);
  }
  stepFor(world, .3, 50);
  world.bond(kFirst, kSecond, 1e8, 1e4);
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    world.model.nodes.velocity[n] = {200 * (world.model.nodes.position[n].x - .04), 0};
  const double energy = totalEnergy(world);
  stepFor(world, .3, 500);
  EXPECT_NEAR(totalEnergy(world) / energy, 1, 2e-3);
}

TEST(ConformMotion, ABodyThatRestsOnADividedSideStaysThere) {
  // The second brick is bonded after the third one has come to rest on the same side of the first.
  World world;
  const double gap = 1e-7;
  for (const auto& [low, high, size] : {std::tuple{Vec2{0, 0}, Vec2{.12, .04}, .02},
                                        {Vec2{0, .04}, Vec2{.048, .07}, .012},
                                        {Vec2{.0515, .04 + gap}, Vec2{.1, .07}, .012}}) {
    const TriangleMesh mesh = blockOf(low, high, size);
    BodySpec spec = resting(mesh);
    hold(spec, mesh, kHeldXY, [](Vec2 at) { return at.y < 1e-9; });
    if (low.x > .05) spec.velocity.assign(mesh.nodes.size(), {0, -.05});
    world.addBody(mesh, spec);
  }
  world.dynamicsSettings.gravity = {0, -1e4};  // makes it touch, and press on
  world.dynamicsSettings.damping = 1e4;
  stepFor(world, .4, 400);
  EXPECT_GT(norm(world.contact.forces()[world.model.nodes.size() - 1]) +
                static_cast<double>(world.contact.touches.size()),
            0);
  const std::size_t nodes = world.model.nodes.size();
  ConformPlan done;
  world.bond(kFirst, kSecond, 1e9, 1e6, &done);
  EXPECT_GT(world.model.nodes.size(), nodes);
  stepFor(world, .4, 1000);
  double lowest = 1;
  for (std::size_t n = 0; n < nodes; ++n)
    if (world.model.nodes.component[n] == kThird)
      lowest = std::min(lowest, world.model.nodes.position[n].y);
  record("lowest", lowest - .04);
  EXPECT_GT(lowest, .04 - 5e-6);  // 5e5 Pa compress the first one by 2e-6 m
  EXPECT_TRUE(world.warnings.empty()) << world.warnings[0];
}

TEST(ConformMotion, CracksOfBodiesRunAcrossDividedSides) {
  World world;
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 7);
  for (const TriangleMesh* mesh : {&left, &right}) {
    BodySpec spec = brittle(kMaterial, 1e6, 10);
    for (const Vec2 x : mesh->nodes) spec.velocity.push_back(400 * (x - Vec2{.04, .01}));
    world.addBody(*mesh, spec);
  }
  world.bond(kFirst, kSecond, 2e6, 20);
  const double start = totalEnergy(world);
  const Vec2 before = sumsOf(world.model).momentum;
  stepFor(world, .3, 250);
  record("cracks", static_cast<double>(world.fracture.numCracks()));
  EXPECT_GT(world.fracture.numCracks(), 20U);
  EXPECT_NEAR(totalEnergy(world) / start, 1, .02);
  EXPECT_NEAR(norm(sumsOf(world.model).momentum - before), 0, 1e-12);
}

}  // namespace
}  // namespace yadefrag::test
