// Bodies come and go, steps are refused, and a scene pays only for what is in it.

#include "step/world.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <sstream>

#include "core/checks.hpp"
#include "elements/element_state.hpp"
#include "step/bodies.hpp"
#include "surface/surface_checks.hpp"

namespace yadefrag::test {
namespace {

TriangleMesh block(Vec2 low, int parts) {
  return structuredRectangle(low, low + Vec2{1, 1}, parts, parts);
}

TEST(WorldBodies, ArraysOfAnotherLengthAreRefused) {
  World world;
  const TriangleMesh mesh = block({0, 0}, 3);
  world.addBody(mesh, moving(mesh, rubber(), {1, 0}));
  const auto refused = [&](const char* name, const auto& change) {
    BodySpec spec = moving(mesh, rubber(), {0, 0});
    change(spec);
    const std::string text = refusalOf([&] { world.addBody(mesh, spec); });
    EXPECT_TRUE(contains(text, name) && contains(text, "7 values") && contains(text, "16 nodes"))
        << text;
  };
  refused("velocity", [](BodySpec& spec) { spec.velocity.resize(7); });
  refused("displacement", [](BodySpec& spec) { spec.displacement.resize(7); });
  refused("held", [](BodySpec& spec) { spec.held.resize(7); });
  refused("smoothNodes", [](BodySpec& spec) { spec.smoothNodes.resize(7); });
  BodySpec mirrored = moving(mesh, rubber(), {0, 0});
  for (const Vec2 node : mesh.nodes) mirrored.displacement.push_back({-2 * node.x, 0});
  const std::string inside = refusalOf([&] { world.addBody(mesh, mirrored); });
  EXPECT_TRUE(contains(inside, "displacement inverts the triangle at (")) << inside;
  TriangleMesh turned = mesh;
  std::swap(turned.triangles[2][0], turned.triangles[2][1]);
  const std::string text = refusalOf([&] {
    world.addBody(turned, moving(turned, rubber(), {0, 0}));
  });
  EXPECT_TRUE(contains(text, "triangle 2")) << text;
  // Nothing has changed.
  EXPECT_EQ(world.model.nodes.size(), 16U);
  EXPECT_EQ(world.model.nodes.reference.size(), 16U);
  EXPECT_EQ(world.model.components.size(), 1U);
  EXPECT_EQ(world.surfaces.segments(), 12U);
  world.step(.5 * world.criticalTimeStep());
}

TEST(WorldBodies, OnlyABodyThatIsThereCanBeRemoved) {
  World world;
  EXPECT_TRUE(contains(refusalOf([&] { world.removeBody(ComponentId(0UL)); }), "body 0"));
  const ComponentId id = addMoving(world, block({0, 0}, 3), rubber(), {1, 0});
  EXPECT_TRUE(contains(refusalOf([&] { world.removeBody(ComponentId(1UL)); }), "body 1"));
  world.removeBody(id);
  EXPECT_TRUE(contains(refusalOf([&] { world.removeBody(id); }), "body 0"));
  EXPECT_EQ(world.model.nodes.size(), 0U);
  EXPECT_EQ(world.surfaces.entries(), 0U);
}

/// What a body is, wherever its nodes are numbered.
struct BodyState {
  std::vector<Vec2> position, velocity, reference;
  std::vector<double> mass;
  std::vector<std::vector<Vec2>> loops;
  friend bool operator==(const BodyState&, const BodyState&) = default;
};

BodyState stateOf(const World& world, ComponentId component) {
  BodyState state;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n) {
    if (world.model.nodes.component[n] != component) continue;
    state.position.push_back(world.model.nodes.position[n]);
    state.velocity.push_back(world.model.nodes.velocity[n]);
    state.reference.push_back(world.model.nodes.reference[n]);
    state.mass.push_back(world.model.nodes.mass[n]);
  }
  for (const BodyLoop& loop : loopsOf(world))
    if (loop.component == component) state.loops.push_back(loop.points);
  return state;
}

/// Bodies of different meshes, straight, smooth, with a load; they move and touch.
World threeBodies() {
  World world;
  for (int k = 0; k < 3; ++k) {
    const TriangleMesh mesh = block({1.01 * k, .1 * k}, 3 + k);
    BodySpec spec = moving(mesh, rubber(), {2. - 2 * k, 0});
    if (k == 1) smoothAll(spec, mesh);
    world.addBody(mesh, spec);
  }
  return world;
}

TEST(WorldBodies, RemovingOneLeavesTheOthersAsTheyAre) {
  for (std::uint32_t gone = 0; gone < 3; ++gone) {
    World world = threeBodies();
    const double dt = .5 * world.criticalTimeStep();
    for (int i = 0; i < 60; ++i) world.step(dt);
    std::vector<BodyState> before;
    for (std::size_t k = 0; k < 3; ++k) before.push_back(stateOf(world, ComponentId(k)));
    const std::size_t nodes = world.model.nodes.size();
    const std::size_t left = nodes - before[gone].position.size();
    world.removeBody(ComponentId(std::size_t{gone}));
    EXPECT_EQ(world.model.nodes.size(), left);
    EXPECT_EQ(world.model.nodes.reference.size(), left);
    EXPECT_TRUE(world.contact.forces().known.empty());
    checkLinks(world.surfaces);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(stateOf(world, ComponentId(k)), k == gone ? BodyState{} : before[k]);
    }
    for (int i = 0; i < 60; ++i) world.step(dt);
    EXPECT_EQ(addMoving(world, block({5, 5}, 2), rubber(), {}), ComponentId(3UL))
        << "numbers of removed bodies are not used again";
    checkLinks(world.surfaces);
    world.step(dt);
  }
}

/// Two bodies press on each other while others, far off, come and go: nothing of that is felt.
TEST(WorldBodies, ContactGoesOnWhileOthersComeAndGo) {
  const auto run = [&](bool others) {
    World world = twoPasses();
    if (others) addMoving(world, block({0, 7}, 4), rubber(), {1, 0});
    addMoving(world, block({0, 0}, 4), rubber(), {0, 1});
    addMoving(world, block({.13, 1.001}, 5), rubber(), {0, -1});
    const double dt = 4e-4;
    EXPECT_LT(dt, world.criticalTimeStep());
    for (int i = 0; i < 40; ++i) {
      if (others && i == 12) addMoving(world, block({4, 7}, 4), rubber(), {});
      if (others && i == 25) world.removeBody(ComponentId(0UL));
      world.step(dt);
      if (i >= 10) {
        EXPECT_FALSE(world.contact.rows().empty()) << "step " << i;
      }
    }
    return world;
  };
  const World alone = run(false), among = run(true);
  for (std::size_t k = 0; k < 2; ++k) {
    const BodyState a = stateOf(alone, ComponentId(k)), b = stateOf(among, ComponentId(k + 1));
    ASSERT_EQ(a.position.size(), b.position.size());
    for (std::size_t n = 0; n < a.position.size(); ++n)
      // The displacement of all bodies decides how much of an overlap a step leaves, some 1e-5 of a
      // segment of .2 m.
      ASSERT_LE(norm(a.position[n] - b.position[n]), 1e-5);
  }
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

TEST(WorldStep, AFinerBodyAndMoreViscosityLowerTheLimit) {
  World world = threeBodies();
  const double dt = .9 * world.criticalTimeStep();
  const auto expectRefused = [&] {
    const std::uint64_t steps = world.steps;
    const std::string text = refusalOf([&] { world.step(dt); });
    EXPECT_TRUE(contains(text, number(dt)) && contains(text, number(world.criticalTimeStep())));
    EXPECT_EQ(world.steps, steps);
  };
  EXPECT_EQ(world.numSearches(), 0U);
  world.step(dt);
  EXPECT_EQ(world.time, dt);
  const ComponentId id = addMoving(world, block({9, 9}, 20), rubber(), {});
  expectRefused();
  world.removeBody(id);
  world.step(dt);
  world.dynamicsSettings.viscosity = {.5, 0};
  expectRefused();
  world.dynamicsSettings.viscosity = {.05, 0};
  world.step(dt);
  EXPECT_EQ(world.steps, 3U);
}

// "Model only what the scene requires."

/// Slip is only computed, and tangential forces only solved for, where both bodies are rough.
TEST(WorldPays, NoFrictionNoTangentialUnknowns) {
  for (const bool rough : {false, true}) {
    World world;
    for (int k = 0; k < 2; ++k) {
      const TriangleMesh mesh = block({.1 * k, 1.0001 * k}, 4 + k);
      BodySpec spec = moving(mesh, rubber(), {1. - 2 * k, 1. - 2 * k});
      spec.friction = k == 0 || rough ? .3 : 0;
      world.addBody(mesh, spec);
    }
    const double dt = .5 * world.criticalTimeStep();
    std::size_t rows = 0, tangential = 0;
    for (int i = 0; i < 40; ++i) {
      world.step(dt);
      for (const ContactRow& row : world.contact.rows()) {
        ++rows;
        tangential += row.friction > 0 || row.slip != 0 || row.tangentForce != 0;
      }
    }
    EXPECT_GT(rows, 100U);
    EXPECT_EQ(tangential, rough ? rows : 0U);
    EXPECT_EQ(world.ledger.friction != 0, rough);
  }
}

TEST(WorldPays, NoLoadsNoArrays) {
  World world = threeBodies();
  const double dt = .5 * world.criticalTimeStep();
  world.step(dt);
  EXPECT_EQ(world.model.nodes.load.capacity(), 0U);
  EXPECT_EQ(world.loads.outerForces.capacity(), 0U);
  EXPECT_EQ(world.ledger.external, 0);
  EXPECT_EQ(world.ledger.damping, 0);
  world.loads.outerForces.assign(world.model.nodes.size(), {1, 0});
  world.step(dt);
  EXPECT_TRUE(world.loads.outerForces.empty()) << "for one step only";
}

TEST(WorldPays, AnEmptyWorldSteps) {
  World world;
  EXPECT_EQ(world.criticalTimeStep(), INFINITY);
  world.step(1);
  EXPECT_EQ(world.time, 1);
  EXPECT_EQ(world.numSearches(), 0U);
}

}  // namespace
}  // namespace yadefrag::test
