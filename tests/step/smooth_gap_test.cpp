// Smooth surfaces lie inside the polygon that was drawn: two round bodies meet later than their
// polygons would, by what the README states.

#include <gtest/gtest.h>
#include <cmath>

#include "benchmark/fe_scenes.hpp"

namespace yadefrag::test {
namespace {

/// Of two equal balls that face each other with a node, halfpoints are the slaves that meet first.
/// They are at the angle π/n, at the radius R cos(π/n): each R sin²(π/n) = h²/4R behind its node.
TEST(SmoothGap, ClosesLaterByTheHalfpointsOfBothBalls) {
  constexpr double kRadius = .5, kGap = .01, kSpeed = 1;
  for (const int sides : {12, 24, 48}) {
    const double side = 2 * kRadius * std::sin(std::numbers::pi / sides);
    World world;
    for (const int k : {0, 1}) {
      std::vector<Vec2> outline;
      for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        outline.push_back(Vec2{k * (2 * kRadius + kGap), 0} +
                          kRadius * Vec2{std::cos(angle), std::sin(angle)});
      }
      const TriangleMesh mesh = triangulate({std::move(outline), {}}, side);
      BodySpec spec;
      spec.material = {1e7, .3, 1000, false};
      spec.selfContact = false;
      spec.velocity.assign(mesh.nodes.size(), {k == 0 ? kSpeed : 0, 0});
      spec.smoothNodes.assign(mesh.nodes.size(), 1);
      world.addBody(mesh, spec);
    }
    const double dt = .2 * world.criticalTimeStep();
    while (world.contact.rows().empty() && world.time < 1) world.step(dt);
    // Found in the step that would end inside.
    EXPECT_NEAR(world.time * kSpeed, kGap + side * side / (2 * kRadius), 2 * dt * kSpeed) << sides;
  }
}

}  // namespace
}  // namespace yadefrag::test
