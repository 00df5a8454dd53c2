// Contact that moves the nodes of cohesive cracks: both are solved together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fracture/two_triangles.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

struct FallResult {
  double fall = 0;   // of the energy: the largest decrease of `contact`, which only dissipates
  double drift = 0;  // of the energy: the balance
  std::size_t held = 0;
};

/// A brittle block falls on a rigid wall, obliquely.
FallResult fall(double partOfCritical, double friction, std::uint64_t seed) {
  const TriangleMesh mesh = triangulate({{{0, .001}, {.1, .001}, {.1, .051}, {0, .051}}, {}}, .008,
                                        {NodeLayout::kScattered, seed});
  BodySpec spec = moving(mesh, {30e9, .2, 2500, false}, {1, -15});
  spec.friction = friction;
  spec.brittle.tensileStrength = 5e6;
  spec.brittle.fractureEnergy = 50;
  World world;
  world.addBody(mesh, spec);
  RigidSpec wall;
  wall.shape.nodes = {{1, 0}, {-1, 0}};
  wall.shape.loops = {{0, 1}};
  wall.friction = friction;
  wall.name = "wall";
  world.addRigid(wall);
  const double dt = partOfCritical * world.criticalTimeStep();
  world.step(dt);
  const double whole = totalEnergy(world);
  FallResult result;
  double highest = 0;
  while (world.time < 4e-4) {
    world.step(dt);
    highest = std::max(highest, world.ledger.contact);
    result.fall = std::max(result.fall, (highest - world.ledger.contact) / whole);
    result.drift = std::max(result.drift, std::abs(totalEnergy(world) / whole - 1));
  }
  result.held = world.fracture.cohesion.edge.size();
  return result;
}

// If the tractions are found before contact and kept, `contact` falls by 1 to 3 %.
TEST(CrackUnderContact, ClosedFacesDoNoWorkAtAnyStep) {
  for (const double part : {.8, .4, .2})
    for (const double friction : {0., .5}) {
      SCOPED_TRACE(part);
      SCOPED_TRACE(friction);
      const FallResult result = fall(part, friction, 1);
      EXPECT_GT(result.held, 20U);  // cracks are still cohesive
      EXPECT_LT(result.fall, 1e-3);
      EXPECT_LT(result.drift, 2e-3);
      record("fall_of_contact", result.fall);
      record("energy_drift", result.drift);
    }
}

}  // namespace
}  // namespace yadefrag::test
