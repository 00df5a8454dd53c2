// The contacts of slaves that a crack has just made.

#include <gtest/gtest.h>

#include <algorithm>

#include "fracture/node_splitting.hpp"
#include "step/bodies.hpp"
#include "step/crack_candidates.hpp"

namespace yadefrag::test {
namespace {

NodeId nodeAt(const World& world, ComponentId component, Vec2 at) {
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    if (world.model.nodes.component[i] == component &&
        norm(world.model.nodes.position[i] - at) < 1e-9)
      return NodeId(i);
  ADD_FAILURE();
  return NodeId::none();
}

EntryId slaveAt(const World& world, NodeId node) {
  return world.surfaces.segmentEntry[world.surfaces.nodeSegment[node.value].value];
}

EdgeId edgeBetween(const World& world, NodeId a, NodeId b) {
  const CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Side side = edges.side(EdgeId(i), 0);
    const NodeId first = firstNode(world.model, side), last = lastNode(world.model, side);
    if ((first == a && last == b) || (first == b && last == a)) return EdgeId(i);
  }
  ADD_FAILURE();
  return EdgeId::none();
}

// A block lies on a floor, a little inside it: what a correction may leave. It cracks upwards from
// the middle of its base.
TEST(CrackTouches, AllPartsOfASlaveHaveItsContacts) {
  constexpr double kLeft = 1e-6;  // m
  World world;
  BodySpec spec;
  spec.material = steel();
  const ComponentId floor = world.addBody(structuredRectangle({-2, -1}, {2, 0}, 1, 1), spec);
  spec.brittle.tensileStrength = 1e6;
  const ComponentId block = world.addBody(structuredRectangle({-1, 0}, {1, 1}, 2, 1), spec);
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n] == block && world.model.nodes.position[n].y == 0)
      world.model.nodes.position[n].y = -kLeft;
  const NodeId middle = nodeAt(world, block, {0, -kLeft}), top = nodeAt(world, block, {0, 1});
  const EntryId master = slaveAt(world, nodeAt(world, floor, {2, 0}));
  const EntryId before = slaveAt(world, middle);

  SplitResult split;
  const EdgeId crack = edgeBetween(world, middle, top);
  splitNodes(world.model, world.fracture.edges, world.surfaces, {&crack, 1}, split);
  relink(world.surfaces, split.sides);
  ASSERT_EQ(split.originals.size(), 2U);
  std::vector<EntryId> slaves{slaveAt(world, middle)};
  for (std::size_t i = 0; i < 2; ++i)
    if (split.originals[i] == middle)
      slaves.push_back(slaveAt(world, NodeId(world.model.nodes.size() - 2 + i)));
  ASSERT_EQ(slaves.size(), 2U);

  // The existing contact keeps its force.
  std::vector<Touch> touches{{{before, master}, 7, 1, -kLeft}};
  inheritTouches(touches, world.surfaces, split.originals, world.model.nodes.size());
  ASSERT_EQ(touches.size(), 2U);
  for (const Touch& touch : touches) {
    EXPECT_EQ(touch.pair.master, master);
    EXPECT_EQ(touch.toleratedGap, -kLeft);
    EXPECT_EQ(touch.normalForce, touch.pair.slave == before ? 7 : 0);
    EXPECT_EQ(std::ranges::count(slaves, touch.pair.slave), 1);
  }
  inheritTouches(touches, world.surfaces, split.originals, world.model.nodes.size());
  EXPECT_EQ(touches.size(), 2U) << "nothing twice";
}

}  // namespace
}  // namespace yadefrag::test
