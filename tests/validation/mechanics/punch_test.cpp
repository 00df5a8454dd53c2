// A rigid flat punch on an ideally plastic half-space (Prandtl 1920; Hill 1950, ch. IX): the mean
// pressure becomes (2 + π) k, for a smooth and for a rough punch.

#include <gtest/gtest.h>

#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kHalf = 10e-3;  // m, half of the punch

/// Mean pressure over (2 + π) k of the right half; the plane x = 0 is one of symmetry.
double punched(double size, bool rough, double degrees, ElementKind kind = ElementKind::kSmoothed,
               NodeLayout layout = NodeLayout::kRows) {
  const double wide = 5 * kHalf, deep = 3 * kHalf;
  const Polygon half{{{0, -deep}, {wide, -deep}, {wide, 0}, {kHalf, 0}, {0, 0}}, {}};
  const TriangleMesh mesh = turnedMesh(half, size, degrees, {layout, 1});
  BodySpec spec = idealSteel(600e6, kind);
  hold(spec, mesh, kHeldXY, [&](Vec2 x) { return x.y < -deep + 1e-9; });
  hold(spec, mesh, kHeldX, [&](Vec2 x) { return x.x < 1e-9 || x.x > wide - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const double speed = 1;  // m/s
  const auto under = nodesWhere(world, [](Vec2 x) { return x.y > -1e-9 && x.x < kHalf * 1.0001; });
  std::vector<NodeId> free, centre;
  for (const NodeId n : under)
    (world.model.nodes.reference[n.value].x < 1e-9 ? centre : free).push_back(n);
  world.prescribe(centre, kHeldXY, {0, -speed});
  world.prescribe(free, rough ? kHeldXY : kHeldY, {0, -speed});
  world.dynamicsSettings.damping = 2e4;
  const double dt = .7 * world.criticalTimeStep();
  const int steps = static_cast<int>(.04 * kHalf / (speed * dt));
  return meanForce(world, under, dt, steps) /
         (kHalf * (2 + std::numbers::pi) * shearStrength(spec));
}

// The end of a punch has a singular stress; with five and ten sides below its half the mean
// pressure is 1.04 and 1.00 of the solution.
TEST(Punch, PrandtlsPressure) {
  for (const bool rough : {false, true})
    for (const double degrees : {0., 15., 30.})
      EXPECT_NEAR(punched(kHalf / 5, rough, degrees), 1, .05) << rough << ' ' << degrees;
  EXPECT_NEAR(punched(kHalf / 10, true, 0), 1, .05);
}

// Linear triangles lock: with five and ten sides 1.10 and 1.04, on irregular meshes 1.13 and 1.06.
TEST(Punch, LockingOfMeshesWithoutRows) {
  for (const double degrees : {0., 15., 30.}) {
    const auto irregular = [&](ElementKind kind) {
      return punched(kHalf / 10, true, degrees, kind, NodeLayout::kScattered);
    };
    EXPECT_NEAR(irregular(ElementKind::kSmoothed), 1, .02) << degrees;
    EXPECT_NEAR(irregular(ElementKind::kLinear), 1.06, .02) << degrees;
  }
  EXPECT_NEAR(punched(kHalf / 5, true, 0, ElementKind::kLinear), 1.105, .015);
}

}  // namespace
}  // namespace yadefrag::test
