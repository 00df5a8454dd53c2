// Warnings: penetration that is too deep, and overlaps that contact in one pass does not detect.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

TEST(EnergyWatch, ReportsDepth) {
  EnergyWatch watch;
  const EnergyLedger ledger;
  WatchedStep step = stepOf(ledger);
  const auto deep = [&](double depth) {
    step.depth = depth;
    return watch.depthMessage(step);
  };
  EXPECT_EQ(deep(.03), "");
  EXPECT_EQ(deep(.2),
            "Step 7, time 0.5 s: bodies overlap by 0.2 m, 0.2 of the shortest segment; "
            "take a shorter step, which helps in about half of such scenes.");
  EXPECT_EQ(deep(.3), "");
  EXPECT_NE(deep(.5), "");
  watch.reportedDepth = 0, step.halo = .06;
  EXPECT_EQ(deep(.02), "");
  EXPECT_NE(deep(.04), "") << "soon lost by a smooth surface";
}

TEST(EnergyWatch, ReportsOverlapsThatOnePassDoesNotDetect) {
  EnergyWatch watch;
  const EnergyLedger ledger;
  const WatchedStep step = stepOf(ledger);
  EXPECT_EQ(watch.overlapMessage(step, .03), "");
  EXPECT_EQ(watch.overlapMessage(step, .2),
            "Step 7, time 0.5 s: bodies overlap by 0.2 m, 0.2 of the shortest segment, at points "
            "that are not checked: with passes=1 only those of the finer boundary are; take "
            "passes=2.");
  EXPECT_EQ(watch.overlapMessage(step, .3), "");
  EXPECT_NE(watch.overlapMessage(step, .5), "");
  EXPECT_FALSE(EnergyWatch::isOverlapDue(7));
  EXPECT_TRUE(EnergyWatch::isOverlapDue(256));
}

/// Two blocks that meet at 20 m/s, of which one stands; `held`: their nodes keep their velocities.
World blow(int passes, int steps, bool held = false) {
  World world;
  world.contactSettings.passes = passes;
  for (int k = 0; k < 2; ++k) {
    const Vec2 low{.01 * k, -.001 * k};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 6 + k, 6 + k, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, steel(), {k == 0 ? 20. : 0., 0});
    if (held) hold(spec, mesh, kHeldXY, [](Vec2) { return true; });
    world.addBody(mesh, spec);
  }
  const double dt = .8 * world.criticalTimeStep();
  while (world.steps < static_cast<std::uint64_t>(steps)) world.step(dt);
  return world;
}

TEST(EnergyWatch, CorrectImpactsGiveNoMessage) {
  for (const int passes : {1, 2}) {
    const World world = blow(passes, 400);
    EXPECT_GT(world.ledger.contact, 0);
    EXPECT_TRUE(world.warnings.empty()) << world.warnings.front();
  }
}

/// Segments are known by node up to the last one of a boundary; the memory behind it has any value.
TEST(EnergyWatch, OverlapsAreCheckedWhereAnInteriorNodeComesLast) {
  World world;
  for (const double x : {0., 1.}) {
    TriangleMesh mesh;
    mesh.nodes = {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}, {x + .5, .5}};
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    mesh.loops = {{0, 1, 2, 3}};
    BodySpec spec = moving(mesh, steel(), {});
    spec.smoothNodes = {1, 0, 0, 1, 0};
    if (x > 0) hold(spec, mesh, kHeldXY, [](Vec2 node) { return node.x > 1.9; });
    world.addBody(mesh, spec);
  }
  world.dynamicsSettings.gravity = {1000, 0};
  std::vector<SegmentId>& segments = world.surfaces.nodeSegment;
  const std::size_t count = segments.size();
  ASSERT_EQ(count + 1, world.model.nodes.size());
  segments.push_back(SegmentId(std::size_t{1} << 31));
  segments.resize(count);
  const double dt = .5 * world.criticalTimeStep();
  bool touched = false;
  while (world.steps < 256) {
    world.step(dt);
    touched = touched || (EnergyWatch::isOverlapDue(world.steps) && !world.contact.rows().empty());
  }
  EXPECT_TRUE(touched);
  EXPECT_TRUE(world.warnings.empty()) << world.warnings.front();
}

/// No force of contact moves nodes that are held: they sink.
TEST(EnergyWatch, HeldBodiesThatMoveIntoEachOtherAreReported) {
  const World world = blow(2, 400, true);
  ASSERT_FALSE(world.warnings.empty());
  EXPECT_TRUE(world.warnings.front().find("bodies overlap by") != std::string::npos)
      << world.warnings.front();
  EXPECT_LT(world.warnings.size(), 8U);
}

}  // namespace
}  // namespace yadefrag::test
