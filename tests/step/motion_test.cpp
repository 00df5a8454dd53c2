// Nodes that a motion moves: where they are, what it costs, and what is refused.

#include "mesh/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <numbers>
#include <numeric>

#include "core/errors.hpp"
#include "meshing/structured.hpp"
#include "step/bodies.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

World oneBlock() {
  World world;
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1, 1}, 3, 3, QuadPattern::kCrossed);
  world.addBody(mesh, moving(mesh, {1e7, .2, 1000, false}, {0, 0}));
  return world;
}

std::vector<NodeId> all(const World& world) {
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n) nodes.emplace_back(n);
  return nodes;
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

TEST(Motion, ReactionsCarryWeightAndLoads) {
  World world = oneBlock();
  world.dynamicsSettings.gravity = {0, -10};
  world.prescribe(all(world), kHeldXY, Vec2{});
  world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {2, 0}));
  world.step(.5 * world.criticalTimeStep());
  const Vec2 sum = std::accumulate(world.reactions.begin(), world.reactions.end(), Vec2{});
  EXPECT_NEAR(sum.y, 1000 * 10, 1e-8);
  EXPECT_NEAR(sum.x, -2. * static_cast<double>(world.model.nodes.size()), 1e-8);
}

TEST(Motion, ReactionAcceleratesABodyThatIsAllHeld) {
  World world = oneBlock();
  world.prescribeMotion(all(world), kHeldXY, {.speedX = TimeTable({0, 1}, {0, 5})});
  const double dt = .5 * world.criticalTimeStep();
  for (int k = 0; k < 5; ++k) world.step(dt);
  const Vec2 sum = std::accumulate(world.reactions.begin(), world.reactions.end(), Vec2{});
  EXPECT_NEAR(sum.x, 1000 * 5, 1e-5);  // 1000 kg, 5 m/s²; speeds are differences of places
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

TEST(Motion, WrongOnesAreRefused) {
  World world = oneBlock();
  const NodeId one[] = {NodeId(0)}, none[] = {NodeId(999)};
  EXPECT_THROW(world.prescribeMotion(none, kHeldXY, {}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldX, {.turn = TimeTable(1)}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldXY, {.centre = {NAN, 0}}), InputError);
  EXPECT_THROW(world.prescribeMotion(one, kHeldX, {.speedX = TimeTable({1, 0}, {0, 0})}),
               InputError);
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
  for (FlatMotions wrong : {flat, flat, flat}) {
    static int how = 0;
    if (how == 0) wrong.numbers.pop_back();
    if (how == 1) wrong.counts.pop_back();
    if (how == 2) wrong.counts[1] = 4000000000U;
    ++how;
    EXPECT_FALSE(unflatten(wrong, again));
  }
}

}  // namespace
}  // namespace yadefrag::test
