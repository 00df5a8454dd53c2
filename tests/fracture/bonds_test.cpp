// Bodies that are bonded along the sides that they have in common.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "extremes/limits.hpp"
#include "fracture/two_sizes.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

// --- a wave

/// Velocities of the upper row of nodes after the pulse.
std::vector<std::array<double, 2>> pulseAbove(const std::vector<TriangleMesh>& parts) {
  const World world = pulseIn(parts, 2e-7);
  std::vector<std::array<double, 2>> result;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.reference[n].y > kHeight - 1e-9)
      result.push_back({world.model.nodes.reference[n].x, world.model.nodes.velocity[n].x});
  std::sort(result.begin(), result.end());
  return result;
}

// A bond that holds makes two nodes move as one: what differs is what its sweeps leave.
TEST(Bonds, ABondedBarCarriesAWaveAsOneBarDoes) {
  const auto whole = pulseAbove({barFrom(0, .4, 4)});
  const auto bonded = pulseAbove({barFrom(0, .1, 4), barFrom(.1, .2, 4), barFrom(.2, .4, 4)});
  double worst = 0;
  for (const auto& point : bonded) {
    const auto isThere = [&](const auto& one) { return std::abs(one[0] - point[0]) < 1e-9; };
    const auto same = std::find_if(whole.begin(), whole.end(), isThere);
    ASSERT_NE(same, whole.end());
    worst = std::max(worst, std::abs((*same)[1] - point[1]));
  }
  figure("bonded_wave", worst, 0, 1e-6);  // of the pulse's 1 m/s
}

// --- grains

TEST(Bonds, ABrickOfGrainsHoldsAndFallsApart) {
  // Four squares meet at a point; pulled apart, then driven against a wall.
  World world;
  for (int k = 0; k < 4; ++k) {
    const Vec2 low{k % 2 == 0 ? 0 : .02, k < 2 ? 0 : .02};
    const TriangleMesh mesh = structuredRectangle(low, low + Vec2{.02, .02}, 4, 4);
    BodySpec spec = moving(mesh, kMaterial, {0, -30});
    world.addBody(mesh, spec);
  }
  const auto id = [](int k) { return ComponentId(static_cast<std::size_t>(k)); };
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 3}, {2, 3}})
    EXPECT_EQ(world.bond(id(a), id(b), 5e6, 50), 4U);
  const std::string text = sentenceOf([&] { world.bond(id(0), id(3), 5e6, 50); });
  EXPECT_NE(text.find("No sides of the bodies 0 and 3"), std::string::npos) << text;
  const TriangleMesh ground = structuredRectangle({-.02, -.0301}, {.035, -.0001}, 8, 4);
  BodySpec spec = moving(ground, kMaterial, {});
  hold(spec, ground, kHeldXY, [](Vec2 at) { return at.y < -.03; });
  world.addBody(ground, spec);
  const double dt = .5 * world.criticalTimeStep();
  const double start = totalEnergy(world);
  double deepest = 0;
  for (int i = 0; i < 2000; ++i) {
    world.step(dt);
    deepest = std::max(deepest, world.contact.maxPenetration());
  }
  EXPECT_LT(world.fracture.cohesion.edge.size(), 16U);  // some broke
  EXPECT_LT(deepest, 1e-2 * .005);
  EXPECT_NEAR(totalEnergy(world) / start, 1, .01);
}

TEST(Bonds, SmallFragmentsAroundABondAreNotTakenOut) {
  World world;
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 4);
  BodySpec spec = resting(left);
  world.addBody(left, spec);
  spec = moving(right, kMaterial, {20, 0});
  spec.brittle.tensileStrength = 1e9;
  world.addBody(right, spec);
  world.bond(kFirst, kSecond, 1e5, 1);
  world.fracture.minFragmentArea = 1e-5;
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 200; ++i) world.step(dt);
  EXPECT_TRUE(world.fracture.cohesion.edge.empty());
  EXPECT_EQ(world.dropped.count, 0U);
}

TEST(Bonds, LeaveWithABody) {
  const auto build = [] {
    World world;
    for (const double begin : {0., .04, .08}) {
      const TriangleMesh mesh = barFrom(begin, begin + .04, 4);
      BodySpec spec = resting(mesh);
      if (begin > .05) spec.velocity.assign(mesh.nodes.size(), {3, 1});
      world.addBody(mesh, spec);
    }
    world.bond(kFirst, kSecond, 5e6, 50);
    world.bond(kSecond, kThird, 5e6, 50);
    return world;
  };
  World world = build();
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 100; ++i) world.step(dt);
  world.removeBody(kFirst);
  EXPECT_EQ(world.fracture.edges.size(), 4U);
  for (const EdgeId edge : world.fracture.cohesion.edge) EXPECT_LT(edge.value, 4U);
  for (int i = 0; i < 100; ++i) world.step(dt);
}

TEST(Bonds, ImpossibleArgumentsAreRefusedAndTheWorldIsUnchanged) {
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 4);
  const auto complaint = [&](const TriangleMesh& other, double strength, double energy) {
    World world;
    world.addBody(left, resting(left));
    world.addBody(other, resting(other));
    std::string text = sentenceOf([&] { world.bond(kFirst, kSecond, strength, energy); });
    EXPECT_EQ(world.fracture.edges.size(), 0U);
    EXPECT_TRUE(world.fracture.cohesion.edge.empty());
    return text;
  };
  EXPECT_NE(complaint(right, 0, 1).find("strength is 0 Pa"), std::string::npos);
  EXPECT_NE(complaint(right, 1, 0).find("energy is 0 J/m²"), std::string::npos);
  EXPECT_NE(complaint(right, INFINITY, 1).find("strength is inf"), std::string::npos);
  EXPECT_NE(complaint(barFrom(.05, .08, 4), 1, 1).find("No sides"), std::string::npos);
  World world;
  world.addBody(left, resting(left));
  EXPECT_NE(sentenceOf([&] { world.bond(kFirst, kFirst, 1, 1); }).find("to itself"),
            std::string::npos);
  EXPECT_NE(sentenceOf([&] { world.bond(kFirst, kSecond, 1, 1); }).find("no body 1"),
            std::string::npos);
  world.addBody(right, resting(right));
  world.bond(kFirst, kSecond, 1e6, 1);
  EXPECT_NE(sentenceOf([&] { world.bond(kFirst, kSecond, 1, 1); }).find("not bonded yet"),
            std::string::npos);
}

TEST(Bonds, AStepThatDoesNotResolveABondIsRefused) {
  const TriangleMesh left = barFrom(0, .04, 4), right = barFrom(.04, .08, 4);
  World world;
  world.addBody(left, resting(left));
  world.addBody(right, resting(right));
  world.bond(kFirst, kSecond, 1e8, .1);
  const double dt = .5 * world.criticalTimeStep();
  const std::string text = sentenceOf([&] { world.step(dt); });
  EXPECT_NE(text.find("energy is 0.1 J/m² of the bond between the bodies 0 and 1 at (0.04"),
            std::string::npos)
      << text;
  EXPECT_EQ(world.steps, 0U);
}

}  // namespace
}  // namespace yadefrag::test
