// Loads on pieces of the boundary.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/errors.hpp"
#include "mesh/motion.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

const ElasticMaterial kRubber{1e7, .2, 1000, false};

World oneBlock(Vec2 low = {0, 0}, Vec2 velocity = {0, 0}) {
  World world;
  addMoving(world, structuredRectangle(low, low + Vec2{1, 1}, 4, 4, QuadPattern::kCrossed), kRubber,
            velocity);
  return world;
}

Vec2 totalMomentum(const World& world) { return momentsOf(world.model.nodes).linear; }

TEST(Pressure, PushesAlongTheNormalAndChangesInTime) {
  World world = oneBlock();
  const double dt = .5 * world.criticalTimeStep();
  world.setPressure(nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 0; }),
                    TimeTable({0, 2 * dt}, {100, 300}));
  double sum = 0;
  for (const double pressure : {100, 200, 300, 300}) {
    world.step(dt);
    sum += pressure * dt;  // on 1 m²
    EXPECT_NEAR(totalMomentum(world).x, sum, 1e-5 * sum);
  }
}

TEST(Pressure, TheLastOneCounts) {
  World world = oneBlock();
  const auto left = nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 0; });
  for (const double pressure : {1., 2., 3.}) world.setPressure(left, TimeTable(pressure));
  EXPECT_EQ(world.loads.pressures.size(), 1U);
  world.setPressure(left, TimeTable(0));
  EXPECT_TRUE(world.loads.pressures.empty());
}

TEST(Pressure, StaysWithItsBodyWhenAnotherLeaves) {
  World world = oneBlock({5, 0});
  addMoving(world, structuredRectangle({0, 0}, {1, 1}, 3, 3, QuadPattern::kCrossed), kRubber, {});
  world.setPressure(nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 0; }), TimeTable(10));
  world.setAbsorbing(nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 1; }));
  world.removeBody(ComponentId(0));
  const double dt = .1 * world.criticalTimeStep();
  world.step(dt);
  EXPECT_NEAR(totalMomentum(world).x, 10 * dt, 1e-9 * dt);
  EXPECT_EQ(world.loads.absorbing.segments.size(), 3U);
  world.removeBody(ComponentId(1));
  EXPECT_TRUE(world.loads.pressures.empty());
  EXPECT_TRUE(world.loads.absorbing.segments.empty());
}

// Sides that come after the call, and are connected with one that has it, from either end.
TEST(Pressure, SpreadsAlongNewSides) {
  World world = oneBlock();
  ContactSurfaces& surfaces = world.surfaces;
  Pressure pressure;
  pressure.segments = {SegmentId(5)};
  pressure.firstNew = 7;
  spread(pressure, surfaces);  // 6, and behind it what is not new
  EXPECT_EQ(pressure.segments, std::vector{SegmentId(5)});
  pressure.segments = {SegmentId(7)};
  spread(pressure, surfaces);
  std::ranges::sort(pressure.segments);
  std::vector<SegmentId> wanted;
  for (std::size_t s = 7; s < surfaces.segments(); ++s) wanted.emplace_back(s);
  EXPECT_EQ(pressure.segments, wanted);
}

/// (N) By the right side, which absorbs, in a tiny step.
Vec2 absorbedBy(World& world) {
  world.setAbsorbing(nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 1; }));
  const Vec2 before = totalMomentum(world);
  const double dt = 1e-6 * world.criticalTimeStep();
  world.step(dt);
  return (1 / dt) * (totalMomentum(world) - before);
}

// Of a body that moves as one, the dashpots take ρcv on each square metre at once: of the triangle
// behind, also with two materials, each behind half of the side.
TEST(Absorbing, TakesImpedanceTimesVelocity) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 2, 2, QuadPattern::kCrossed);
  for (const ElasticMaterial& second : {kRubber, ElasticMaterial{9e7, .2, 4000, false}}) {
    BodySpec spec = moving(mesh, kRubber, {.1, .2});
    BodyMaterial one, other;
    one.material = kRubber, other.material = second;
    spec.materials.materials = {one, other};
    spec.materials.ofTriangle =
        byTriangle<std::uint32_t>(mesh, [](Vec2 x) { return x.y < .5 ? 0 : 1; });
    World world;
    world.addBody(mesh, spec);
    const Vec2 force = absorbedBy(world);
    const auto mean = [&](double a, double b) {
      return (std::sqrt(kRubber.density * a) + std::sqrt(second.density * b)) / 2;
    };
    const double along = mean(kRubber.waveModulus(), second.waveModulus());
    const double across = mean(kRubber.shearModulus(), second.shearModulus());
    EXPECT_NEAR(force.x, -.1 * along, 1e-7 * along);
    EXPECT_NEAR(force.y, -.2 * across, 1e-7 * across);
    EXPECT_NEAR(world.ledger.damping, -dot(force, {.1, .2}) * world.lastDt,
                1e-5 * world.ledger.damping);
  }
}

TEST(Absorbing, TheEnergyBalanceHolds) {
  World world = oneBlock({0, 0}, {.1, .2});
  world.setAbsorbing(nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 1 || x.y == 0; }));
  const double before = world.kineticEnergy();
  stepFor(world, .8, 400);
  const double now = world.kineticEnergy() + world.strainEnergy();
  EXPECT_LT(now, .1 * before);
  EXPECT_NEAR(totalEnergy(world), before, 1e-6 * before);
}

// --- Nodes that a motion moves: where they are, what it costs, and what is refused.

std::vector<NodeId> all(const World& world) {
  return nodesWhere(world.model.nodes, [](Vec2) { return true; });
}

// Rounding of the place alone, however many steps: 10⁻¹⁵ of a radius of 3 m.
TEST(Motion, TurnStaysOnItsCircle) {
  World world = oneBlock();
  const Vec2 centre{-1, 2};
  world.prescribeMotion(all(world), kHeldXY, {.centre = centre, .turn = TimeTable(100)});
  const std::vector<Vec2> start = world.model.nodes.position;
  const double dt = .5 * world.criticalTimeStep();
  while (world.time < 20 * std::numbers::pi / 100) world.step(dt);
  for (std::size_t n = 0; n < start.size(); ++n)
    EXPECT_NEAR(norm(world.model.nodes.position[n] - centre), norm(start[n] - centre), 1e-14);
}

/// They accelerate a body that is all held, too.
TEST(Motion, ReactionsCarryWeightAndLoads) {
  const auto sumOf = [](const World& world) {
    return std::accumulate(world.reactions.begin(), world.reactions.end(), Vec2{});
  };
  World loaded = oneBlock(), moved = oneBlock();
  loaded.dynamicsSettings.gravity = {0, -10};
  loaded.prescribe(all(loaded), kHeldXY, Vec2{});
  loaded.setLoads(std::vector<Vec2>(loaded.model.nodes.size(), {2, 0}));
  stepFor(loaded, .5, 1);
  EXPECT_NEAR(sumOf(loaded).y, 1000 * 10, 1e-8);
  EXPECT_NEAR(sumOf(loaded).x, -2. * static_cast<double>(loaded.model.nodes.size()), 1e-8);
  moved.prescribeMotion(all(moved), kHeldXY, {.speedX = TimeTable({0, 1}, {0, 5})});
  stepFor(moved, .5, 5);
  EXPECT_NEAR(sumOf(moved).x, 1000 * 5, 1e-5);  // kg, m/s²; speeds are differences of places
}

TEST(Motion, UnusedOnesAreRemoved) {
  World world = oneBlock();
  for (int k = 0; k < 5; ++k) {
    world.prescribeMotion(all(world), kHeldXY, {.turn = TimeTable(k)});
    EXPECT_EQ(world.model.motions.size(), 1U);
  }
  const NodeId one[] = {NodeId(0)};
  world.prescribeMotion(one, kHeldX, {.speedX = TimeTable(1)});
  EXPECT_EQ(world.model.motions.size(), 2U);
  world.prescribe(all(world), kFree, Vec2{});
  EXPECT_TRUE(world.model.motions.empty());
  EXPECT_TRUE(world.model.nodes.motion.empty());
}

TEST(Loads, WrongOnesAreRefused) {
  World world = oneBlock();
  const NodeId one[] = {NodeId(0)}, none[] = {NodeId(999)};
  const auto left = nodesWhere(world.model.nodes, [](Vec2 x) { return x.x == 0; });
  const TimeTable backwards({1, 0}, {1, 1});
  EXPECT_THROW(world.setPressure(one, TimeTable(1)), InputError);
  EXPECT_THROW(world.setPressure(none, TimeTable(1)), InputError);
  EXPECT_THROW(world.setPressure(left, backwards), InputError);
  EXPECT_THROW(world.setAbsorbing(one), InputError);
  EXPECT_THROW(world.prescribeMotion(none, kHeldXY, {}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldX, {.turn = TimeTable(1)}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldXY, {.centre = {NAN, 0}}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldX, {.speedX = backwards}), InputError);
  EXPECT_TRUE(world.loads.pressures.empty() && world.loads.absorbing.segments.empty());
  EXPECT_TRUE(world.model.motions.empty());
}

TEST(Motion, FlatNumbersGiveItBack) {
  const std::vector<Motion> motions{
      {.centre = {1, 2}, .begin = 3, .speedX = TimeTable({0, 1}, {2, 3}), .turn = TimeTable(4)},
      {.speedY = TimeTable(5), .function = 6}};
  const FlatMotions flat = flatten(motions);
  std::vector<Motion> again;
  ASSERT_TRUE(unflatten(flat, again));
  EXPECT_EQ(flatten(again).numbers, flat.numbers);
  EXPECT_EQ(flatten(again).counts, flat.counts);
  for (const int how : {0, 1, 2}) {
    FlatMotions wrong = flat;
    if (how == 0) wrong.numbers.pop_back();
    if (how == 1) wrong.counts.pop_back();
    if (how == 2) wrong.counts[1] = 4000000000U;
    EXPECT_FALSE(unflatten(wrong, again));
  }
}

}  // namespace
}  // namespace yadefrag::test
