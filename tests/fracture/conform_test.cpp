// Bodies bonded along sides that did not match node by node.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/checks.hpp"
#include "elements/element_state.hpp"
#include "extremes/limits.hpp"
#include "fracture/laboratory.hpp"
#include "fracture/random_cracks.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

// --- what a division leaves as it was

/// Two bars of different sizes and a body that comes after them, with random velocities; deformed,
/// or with initial stress.
World stressedBars(bool isDeformed) {
  World world;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const TriangleMesh& mesh : {barFrom(0, .04, 2), barFrom(.04, .08, 7), barFrom(.1, .12, 3)}) {
    BodySpec spec = brittle(kMaterial, 1e8, 1e4);
    spec.brittle.weibullModulus = 5;
    for (const Vec2 at : mesh.nodes) {
      spec.velocity.push_back({unit(random), unit(random)});
      if (isDeformed) spec.displacement.push_back({1e-3 * at.x, 2e-3 * at.x + 4e-4 * at.y});
    }
    if (!isDeformed) spec.stress.assign(mesh.triangles.size(), {1e6, -2e6, 5e5});
    world.addBody(mesh, spec);
  }
  return world;
}

TEST(Conform, DividedTrianglesKeepStressMassMomentumAndCracks) {
  for (const bool isDeformed : {false, true}) {
    World world = stressedBars(isDeformed);
    const auto former = stresses(world.model);
    const std::size_t lastFirst = world.model.components[2].firstTriangle;
    const double mass = sumsOf(world.model).mass, strain = world.strainEnergy();
    const Vec2 before = sumsOf(world.model).momentum;
    const std::size_t triangles = former.size(), nodes = world.model.nodes.size();
    ConformPlan done;
    // The middle of the coarse side is in the middle of one of the seven.
    EXPECT_EQ(world.bond(kFirst, kSecond, 1e6, 1e3, &done), 8U);
    EXPECT_EQ(done.corners + done.moves.size(), 0U);
    EXPECT_EQ(done.newNodes.size(), 7U);
    EXPECT_EQ(world.model.triangles.size(), triangles + 7);
    EXPECT_EQ(world.model.nodes.size(), nodes + 7);
    EXPECT_EQ(world.model.nodes.reference.size(), nodes + 7);
    EXPECT_NEAR(bondedLength(world) / kHeight, 1, 1e-12);
    EXPECT_NEAR(sumsOf(world.model).mass / mass, 1, 1e-12);
    EXPECT_NEAR(world.strainEnergy() / strain, 1, 1e-9);
    EXPECT_NEAR(norm(sumsOf(world.model).momentum - before), 0, 1e-14 * mass);
    const auto now = stresses(world.model);
    // Triangles of a later body keep their order, with higher numbers; all of the others are
    // stressed alike.
    EXPECT_EQ(world.model.components[2].firstTriangle, lastFirst + 7);
    for (std::size_t e = 0; e < now.size(); ++e)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(now[e][k], former[e < lastFirst + 7 ? 0 : e - 7][k], 1e-9 * 1e7);
    checkFans(world.model, world.fracture.edges);
    checkEdges(world.model, world.fracture.edges);
  }
}

// --- masonry

TEST(Conform, ABrickIsBondedOnTwoHalfBricksShiftedByAnyPartOfAnElement) {
  double shortest = 1;
  for (const double upper : {.01, .0075, .0043})
    for (int k = 0; k <= 40; ++k) {
      const double part = k / 20.;
      World world = tJunction(part, .1 * k, upper);
      const double mass = sumsOf(world.model).mass, critical = world.criticalTimeStep();
      ConformPlan done;
      const CommonSides found = world.bondAll(1e-6, 1e8, 1e4, &done);
      EXPECT_EQ(found.unmatched, 0U) << part << ' ' << upper;
      // Corners that were joined shorten or lengthen what is common.
      const double joined = static_cast<double>(done.corners) * done.farthest;
      EXPECT_NEAR(bondedLength(world), .04 + .12 - part * .01, 1e-9 + joined)
          << part << ' ' << upper;
      EXPECT_LE(done.farthest, .2 * .01 + 1e-9);
      if (done.corners == 0) {
        EXPECT_NEAR(sumsOf(world.model).mass / mass, 1, 1e-12);
      }
      shortest = std::min(shortest, world.criticalTimeStep() / critical);
    }
  record("shortest_step", shortest);
  EXPECT_GT(shortest, .15);
}

/// Stones in courses, each with its own size of elements.
World rubble(std::mt19937& random, bool cracks) {
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  World world;
  const double angle = draw(0, 6);
  double y = 0;
  for (int course = 0; course < 3; ++course) {
    const double high = y + draw(.05, .12);
    for (double x = 0; x < 1;) {
      const double end = x + draw(.1, .3);
      const Polygon stone{turnedLoop(box({x, y}, {end, high}), angle), {}};
      const PolygonMesh mesh = triangulate(stone, SizeField(draw(.015, .04)));
      world.addBody(mesh, cracks ? brittle(kMaterial, 1e8, 1e5) : resting(mesh));
      x = end;
    }
    y = high;
  }
  return world;
}

TEST(Conform, RubbleMasonryOfAnySizesIsBondedCompletely) {
  std::mt19937 random(11);
  double shortest = 1, sum = 0;
  for (int k = 0; k < 60; ++k) {
    World world = rubble(random, k % 2 == 1);
    const double mass = sumsOf(world.model).mass, critical = world.criticalTimeStep();
    ConformPlan done;
    const CommonSides found = world.bondAll(1e-6, 1e7, 1e5, &done);
    EXPECT_EQ(found.unmatched, 0U) << k << ": " << found.place.x << ' ' << found.place.y;
    EXPECT_GT(found.pairs.size(), 40U);
    EXPECT_NEAR(sumsOf(world.model).mass / mass, 1, done.corners == 0 ? 1e-9 : 1e-3);
    for (const double area : world.model.triangles.area) EXPECT_GT(area, 0);
    checkFans(world.model, world.fracture.edges);
    checkEdges(world.model, world.fracture.edges);
    const double ratio = world.criticalTimeStep() / critical;
    shortest = std::min(shortest, ratio), sum += ratio / 60;
  }
  record("shortest_step", shortest);
  record("mean_step", sum);
  EXPECT_GT(shortest, .12);
}

// --- gaps and curves

TEST(Conform, CornersAndNodesWithSmallErrorsAreJoinedWithinTheTolerance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> error(-2e-4, 2e-4);
  World world;
  for (const auto& [low, high, size] : {std::tuple{Vec2{0, 0}, Vec2{.06, .04}, .01},
                                        {Vec2{.0605, 0}, Vec2{.12, .04}, .007},
                                        {Vec2{.03, .0404}, Vec2{.09, .08}, .01}}) {
    TriangleMesh mesh = blockOf(low, high, size);
    for (Vec2& node : mesh.nodes) node += {error(random) / 2, error(random) / 2};
    world.addBody(mesh, resting(mesh));
  }
  const CommonSides found = world.bondAll(1e-3, 1e8, 1e4);
  EXPECT_EQ(found.unmatched, 0U);
  EXPECT_NEAR(bondedLength(world), .04 + .06, 3e-3);
  for (const auto& [a, b] : found.pairs) {
    const auto at = [&](NodeId node) { return world.model.nodes.position[node.value]; };
    EXPECT_EQ(at(firstNode(world.model, a)), at(lastNode(world.model, b)));
    EXPECT_EQ(at(lastNode(world.model, a)), at(firstNode(world.model, b)));
  }
  stepFor(world, .5, 20);
  EXPECT_NEAR(world.strainEnergy(), 0, 1e-12);  // gaps were closed without stress
}

Polygon ringOf(double radius, int corners, double outer = 0) {
  Loop loop = circle({}, radius, corners);
  if (outer == 0) return {loop, {}};
  std::reverse(loop.begin(), loop.end());
  return {box({-outer, -outer}, {outer, outer}), {loop}};
}

TEST(Conform, ADiscIsBondedIntoAHoleOfOtherSides) {
  for (const bool smooth : {false, true}) {
    World world;
    const PolygonMesh disc = triangulate(ringOf(.01, 40), SizeField(.0016));
    const PolygonMesh plate =
        triangulate(ringOf(.01 / std::cos(M_PI / 24), 24, .02), SizeField(.0027));
    for (const PolygonMesh* mesh : {&disc, &plate}) {
      BodySpec spec = moving(*mesh, kMaterial, {1, 2});
      spec.smoothNodes.resize(mesh->nodes.size());
      if (smooth)
        for (std::size_t n = 0; n < mesh->nodes.size(); ++n)
          spec.smoothNodes[n] = norm(mesh->nodes[n]) < .0101 ? 1 : 0;
      world.addBody(*mesh, spec);
    }
    const CommonSides found = world.bondAll(2e-4, 1e8, 1e5);
    EXPECT_EQ(found.unmatched, 0U);
    EXPECT_NEAR(bondedLength(world) / (2 * M_PI * .01), 1, .01);
    const double energy = totalEnergy(world);
    stepFor(world, .5, 200);
    EXPECT_NEAR(totalEnergy(world) / energy, 1, 1e-9) << smooth;
  }
}

// --- data by node, side and triangle

TEST(Conform, HeldNodesPressureAndLoadsFollow) {
  World world;
  const TriangleMesh left = barFrom(0, .04, 2), right = barFrom(.04, .08, 5);
  BodySpec spec = resting(left);
  hold(spec, left, kHeldXY, [](Vec2 at) { return at.x > .04 - 1e-9; });
  world.addBody(left, spec);
  world.addBody(right, resting(right));
  std::vector<NodeId> rim;
  for (std::size_t n = 0; n < left.nodes.size(); ++n)
    if (left.nodes[n].x > .04 - 1e-9) rim.emplace_back(n);
  world.setPressure(rim, TimeTable({0, 1}, {5, 5}));
  world.setAbsorbing(rim);
  world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {1, 1}));
  const std::size_t nodes = world.model.nodes.size();
  ConformPlan done;
  world.bond(kFirst, kSecond, 1e8, 1e4, &done);
  const std::size_t added = world.model.nodes.size() - nodes;
  ASSERT_GT(added, 0U);
  double held = 0;
  for (const SegmentId segment : world.loads.pressures[0].segments) {
    const NodeId a = world.surfaces.segmentNode[segment.value];
    const NodeId b = world.surfaces.segmentNode[world.surfaces.segmentNext[segment.value].value];
    held += norm(world.model.nodes.position[b.value] - world.model.nodes.position[a.value]);
    EXPECT_EQ(world.model.nodes.held[a.value], kHeldXY);
  }
  EXPECT_NEAR(held, kHeight, 1e-12);
  EXPECT_EQ(world.loads.absorbing.segments.size(), world.loads.pressures[0].segments.size());
  for (std::size_t n = nodes; n < world.model.nodes.size(); ++n)
    EXPECT_EQ(world.model.nodes.load[n], Vec2());
  stepFor(world, .5, 50);
}

TEST(Conform, ARefusedBondLeavesTheWorldUnchanged) {
  // All nodes move by a motion, so that none slides, and two corners are too near each other.
  World world = tJunction(.05, 0, .01);
  const std::vector<NodeId> all = nodesWhere(world.model.nodes, [](Vec2) { return true; });
  world.prescribeMotion(all, kHeldXY, {.speedX = TimeTable({0, 1}, {1, 1})});
  const std::string before = saved(world);
  const std::string text = sentenceOf([&] { world.bond(kFirst, kThird, 1e6, 1e4); });
  EXPECT_TRUE(contains(text, "have different ends"));
  EXPECT_EQ(saved(world), before);
}

}  // namespace
}  // namespace yadefrag::test
