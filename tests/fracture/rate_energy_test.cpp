// Two triangles whose edge cracks with the factor of a rate effect.

#include <gtest/gtest.h>

#include <cmath>

#include "fracture/two_triangles.hpp"

namespace yadefrag::test {
namespace {

/// (J) Spent by the edge, which cracks at 1.3 of its strength and is torn apart. With a factor of
/// 1.2 by the rate effect, or as the values of the material.
double spentWith(double power, bool byRate) {
  constexpr double kFactor = 1.2;
  World world;
  BodySpec spec;
  if (byRate) spec.brittle.rate = RateEffect({{1, kFactor}, {10, kFactor}});
  spec.brittle.rateEnergyPower = power;
  addTwoTriangles(world, spec, 1.3);
  CrackEdges& edges = world.fracture.edges;
  if (!byRate) edges.strength[0] *= kFactor, edges.fractureEnergy[0] *= std::pow(kFactor, power);
  constexpr double kDt = 1e-11, kSpeed = 200;  // s, m/s
  world.step(kDt);
  EXPECT_EQ(world.fracture.numCracks(), 1U);
  EXPECT_EQ(world.fracture.hasRaised(), byRate);
  EXPECT_DOUBLE_EQ(edges.strength[0], kFactor * kStrength);
  EXPECT_DOUBLE_EQ(edges.fractureEnergy[0], std::pow(kFactor, power) * kEnergy);
  for (std::size_t element = 0; element < 2; ++element)
    for (const NodeId node : world.model.triangles.nodes[element])
      world.model.nodes.velocity[node.value] = {element == 0 ? -kSpeed : kSpeed, 0};
  for (int n = 0; n < 2000 && !world.fracture.cohesion.edge.empty(); ++n) world.step(kDt);
  EXPECT_TRUE(world.fracture.cohesion.edge.empty());
  return world.ledger.fracture;
}

// The triangles vibrate when the edge cracks, which dissipates up to 0.7 % of Gc in addition.
TEST(RateEnergy, FollowsTheFactorByItsPower) {
  for (const double power : {0., 1., 2.}) {
    const double spent = spentWith(power, true);
    EXPECT_DOUBLE_EQ(spent, spentWith(power, false)) << power;
    EXPECT_NEAR(spent / (kEnergy * kArea * std::pow(1.2, power)), 1, .01) << power;
  }
}

// At 1.3 of the strength a slow test would have cracked it.
TEST(RateEnergy, AnEdgeHoldsBelowTheStrengthOfItsRate) {
  for (const double factor : {1.2, 1.4}) {
    World world;
    BodySpec spec;
    spec.brittle.rate = RateEffect({{1, factor}, {10, factor}});
    addTwoTriangles(world, spec, 1.3);
    world.step(1e-11);
    EXPECT_EQ(world.fracture.numCracks(), factor < 1.3 ? 1U : 0U) << factor;
    EXPECT_EQ(world.fracture.hasRaised(), factor < 1.3) << factor;
  }
}

}  // namespace
}  // namespace yadefrag::test
