// Bodies far from all others are not watched node by node, and nothing is missed for that. The
// yardstick are the same bodies with contact with themselves, which are always watched: blocks
// never touch themselves at these speeds (at 40 m/s one is bent so far that it does).

#include <gtest/gtest.h>
#include <algorithm>

#include <random>

#include "core/errors.hpp"
#include "step/run_result.hpp"

namespace yadefrag::test {
namespace {

/// Blocks in a row, `gap` (m) apart, the outer ones fly inwards at `speed` (m/s).
World row(double gap, double speed, bool selfContact) {
  World world;
  // So that only what is missed counts: sweeps leave a part of the displacement in a step.
  world.contactSettings.constants.stop = 1e-6, world.contactSettings.constants.rowSweeps = 1000;
  for (int k = 0; k < 4; ++k) {
    const Vec2 low{(1 + gap) * k, .13 * k};
    const TriangleMesh mesh = structuredRectangle(low, low + Vec2{1, 1}, 4 + k, 4 + k);
    BodySpec spec = moving(mesh, rubber(), {k == 0 ? speed : k == 3 ? -speed : 0, 0});
    spec.selfContact = selfContact;
    world.addBody(mesh, spec);
  }
  return world;
}

class Apart : public testing::TestWithParam<double> {};

/// From far away, through blows, until they have come apart again; every now and then some body is
/// hit by a force that makes it many times faster.
TEST_P(Apart, NothingIsMissed) {
  const double speed = GetParam();
  World seldom = row(1, speed, false), always = row(1, speed, true);
  const double dt = .5 * seldom.criticalTimeStep();
  const int steps = static_cast<int>(4 / (speed * dt));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t touched = 0, fewest = always.model.nodes.size();
  for (int i = 0; i < steps; ++i) {
    if (i % (steps / 7) == 3) {
      const ComponentId hit(static_cast<std::size_t>(random() % 4));
      const Vec2 push = speed * Vec2{any(random), .1 * any(random)};
      for (World* world : {&seldom, &always}) {
        world->loads.outerForces.assign(world->model.nodes.size(), {});
        for (std::size_t n = 0; n < world->model.nodes.size(); ++n)
          if (world->model.nodes.component[n] == hit)
            world->loads.outerForces[n] = world->model.nodes.mass[n] / dt * push;
      }
    }
    seldom.step(dt);
    always.step(dt);
    // Contact is solved to a part of the largest displacement of a node that is watched.
    for (std::size_t n = 0; n < seldom.model.nodes.size(); ++n)
      ASSERT_LT(norm(seldom.model.nodes.position[n] - always.model.nodes.position[n]), 1e-6)
          << "step " << i;
    touched += seldom.contact.rows().size();
    fewest = std::min(fewest, seldom.surfaceNodes().size());
  }
  EXPECT_GT(touched, 20U);
  EXPECT_EQ(fewest, 0U) << "at some time no body is watched";
  EXPECT_LT(seldom.numSearches(), .9 * always.numSearches());
}

INSTANTIATE_TEST_SUITE_P(Speeds, Apart, testing::Values(3., 15., 30.));

/// While two blocks hit each other, the nodes of a distant one are not checked.
TEST(ApartBodies, OnlyThoseThatAreNearAreWatched) {
  World world = row(.02, 10, false);
  const TriangleMesh mesh = structuredRectangle({0, 40}, {1, 41}, 6, 6);
  BodySpec spec = moving(mesh, rubber(), {10, 0});
  spec.selfContact = false;
  const ComponentId far = world.addBody(mesh, spec);
  const double dt = .5 * world.criticalTimeStep();
  std::size_t touched = 0;
  for (int i = 0; i < 100; ++i) {
    world.step(dt);
    touched += world.contact.rows().size();
    for (const NodeId node : world.surfaceNodes())
      ASSERT_NE(world.model.nodes.component[node.value], far);
  }
  EXPECT_GT(touched, 100U);
  EXPECT_GT(world.surfaceNodes().size(), 0U);
}

/// (m) Throws the last body `way` towards the others in one step.
void throwLast(World& world, double way, double dt) {
  world.loads.outerForces.assign(world.model.nodes.size(), {});
  const ComponentId last(world.model.components.size() - 1);
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == last)
      world.loads.outerForces[n] = {-world.model.nodes.mass[n] * way / (dt * dt), 0};
}

/// A body that is not watched is thrown to its neighbour in one step: the step finds it there.
TEST(ApartBodies, ThrownInOneStep) {
  World world = row(1, 0, false);
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 5; ++i) world.step(dt);
  EXPECT_EQ(world.surfaceNodes().size(), 0U);
  EXPECT_EQ(world.numSearches(), 1U);
  throwLast(world, .98, dt);
  world.step(dt);
  EXPECT_EQ(world.numSearches(), 2U);
  EXPECT_GT(world.contact.candidates.size(), 0U);
  EXPECT_GT(world.surfaceNodes().size(), 0U);
  throwLast(world, 0, dt);
  for (int i = 0; i < 3; ++i) {
    for (Vec2& velocity : world.model.nodes.velocity) velocity = .02 * velocity;
    world.step(dt);
    EXPECT_LE(deepestNode(world), 1e-6);
  }
}

/// Across all others in one step: refused, and everything is as before.
TEST(ApartBodies, ThrownBeyondTheOthers) {
  World world = row(1, 0, false);
  const double dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 5; ++i) world.step(dt);
  const std::vector<Vec2> position = world.model.nodes.position,
                          velocity = world.model.nodes.velocity;
  throwLast(world, 9, dt);
  EXPECT_THROW(world.step(dt), RunError);
  EXPECT_EQ(world.steps, 5U);
  for (std::size_t n = 0; n < position.size(); ++n) {
    EXPECT_LE(norm(world.model.nodes.position[n] - position[n]), 1e-14);
    EXPECT_LE(norm(world.model.nodes.velocity[n] - velocity[n]), 1e-9);
  }
  world.loads.outerForces.clear();
  for (int i = 0; i < 5; ++i) world.step(dt);
  EXPECT_TRUE(world.contact.rows().empty());
}

}  // namespace
}  // namespace yadefrag::test
