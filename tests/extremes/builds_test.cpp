// A release build and one for debugging give the same: both are held to the same figures.

#include <gtest/gtest.h>

#include "extremes/saved_world.hpp"

namespace yadefrag::test {
namespace {

/// (relative) Both give the same bits with Debian's compiler; another one's √ and sums may round
/// otherwise, and 300 steps of contact make some hundred times that of it.
constexpr double kAgreement = 1e-12;

// Cracks, cohesion, friction, smooth surfaces, two passes.
TEST(ExtremeBuilds, DebugAndReleaseAgree) {
  World world = eventfulWorld();
  for (int i = 0; i < 300; ++i) world.step(world.lastDt);
  const Nodes& nodes = world.model.nodes;
  ASSERT_EQ(nodes.size(), 291U);
  EXPECT_EQ(world.fracture.numCracks(), 113U);
  Vec2 places;
  double speeds = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    places += nodes.position[n], speeds += norm(nodes.velocity[n]);
  const auto expectNear = [](double value, double wanted) {
    EXPECT_NEAR(value, wanted, kAgreement * wanted);
  };
  expectNear(places.x, 3.6430002001557953);
  expectNear(places.y, 1.4470867826392377);
  expectNear(speeds, 4588.9575169145764);
  expectNear(totalEnergy(world), 89.999577295195351);
  expectNear(world.ledger.contact, 5.4998862108601845);
}

}  // namespace
}  // namespace yadefrag::test
