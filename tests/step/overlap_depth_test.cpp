// The oracle of overlaps, against closed forms and against every pair of triangles. Warnings:
// penetration that is too deep, and overlaps that contact in one pass does not detect.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/checks.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"
#include "step/overlap_check.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

using Corners = std::array<Vec2, 3>;

void addSquare(World& world, Vec2 low, double side) {
  addMoving(world, structuredRectangle(low, low + Vec2{side, side}, 4, 4), rubber(), {});
}

/// Two squares that touch, or overlap by d along one axis, and, in the second scene, a corner in a
/// corner by (d, 3d): bodies that lie in each other like this are refused, so one is moved
/// afterwards.
TEST(OverlapDepth, OfSquaresIsTheirOverlap) {
  for (const double d : {0., 1e-9, 1e-4, .02}) {
    for (const Vec2 at : {Vec2{1 - d, .1}, Vec2{.1, 1 - d}, Vec2{1 - d, 1 - 3 * d}}) {
      World world;
      addSquare(world, {}, 1);
      addSquare(world, {3, 3}, 1);
      Model& model = world.model;
      EXPECT_EQ(deepestOverlap(model), 0);
      for (std::size_t n = 0; n < model.nodes.size(); ++n)
        if (model.nodes.component[n] == ComponentId(1U)) model.nodes.position[n] += at - Vec2{3, 3};
      EXPECT_NEAR(deepestOverlap(model), d, d > 0 ? 1e-15 : 0);
    }
  }
}

/// The tip of an obtuse triangle in a side, by d along the side's normal.
TEST(OverlapDepth, OfATipInASideIsTheTipsDepth) {
  const Corners below{Vec2{-1, -1}, Vec2{1, -1}, Vec2{0, 3}};
  for (const double d : {1e-6, .01}) {
    const Corners tip{Vec2{0, -1 + d}, Vec2{-2, -2}, Vec2{2, -2}};
    const Corners turned{tip[1], tip[2], tip[0]};
    EXPECT_NEAR(overlapOf(below, turned), d, 1e-15);
    EXPECT_NEAR(overlapOf(turned, below), d, 1e-15);
  }
}

/// Random triangles without common nodes: the push is enough, nothing shorter in any of 720
/// directions is, and the search misses no pair.
TEST(OverlapDepth, IsTheShortestPushOfAnyPair) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> even(0, 1);
  for (int scene = 0; scene < 20; ++scene) {
    Model model;
    std::vector<Corners> all;
    while (all.size() < 60) {
      const Vec2 at{8 * even(random), 8 * even(random)};
      Corners corners;
      for (Vec2& corner : corners) corner = at + Vec2{even(random), even(random)};
      if (cross(corners[1] - corners[0], corners[2] - corners[0]) < .1) continue;
      all.push_back(corners);
      const std::size_t first = model.nodes.size();
      for (const Vec2 corner : corners) model.nodes.position.push_back(corner);
      model.triangles.nodes.push_back({NodeId(first), NodeId(first + 1), NodeId(first + 2)});
      model.triangles.area.push_back(1);
    }
    double deepest = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        double least = INFINITY;
        for (int turn = 0; turn < 720; ++turn) {
          const double angle = turn * 3.14159265358979 / 360;
          const Vec2 away{std::cos(angle), std::sin(angle)};
          double highest = -INFINITY, lowest = INFINITY;
          for (const Vec2 p : all[i]) highest = std::max(highest, dot(p, away));
          for (const Vec2 p : all[k]) lowest = std::min(lowest, dot(p, away));
          least = std::min(least, std::max(0., highest - lowest));
        }
        const double found = overlapOf(all[i], all[k]);
        ASSERT_LE(found, least + 1e-15);
        // A quarter of a degree beside the best direction, a diameter of 1.4 reaches 0.006 farther.
        ASSERT_GE(found, least - .007);
        deepest = std::max(deepest, found);
      }
    EXPECT_EQ(deepestOverlap(model), deepest);
    model.triangles.area.assign(all.size(), 0);
    EXPECT_EQ(deepestOverlap(model), 0) << "dropped triangles are not there";
  }
}

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
  World world = inPasses(passes);
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

TEST(EnergyWatch, HeldBodiesThatSinkAreReportedAndCorrectImpactsAreNot) {
  for (const int passes : {1, 2}) {
    const World world = blow(passes, 400);
    EXPECT_GT(world.ledger.contact, 0);
    EXPECT_TRUE(world.warnings.empty()) << world.warnings.front();
  }
  // No force of contact moves nodes that are held: they sink.
  const World held = blow(2, 400, true);
  ASSERT_FALSE(held.warnings.empty());
  EXPECT_TRUE(contains(held.warnings.front(), "bodies overlap by"));
  EXPECT_LT(held.warnings.size(), 8U);
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

}  // namespace
}  // namespace yadefrag::test
