// Nodes that split: what the dynamics follow has the same bits as what is built from scratch.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/same_bits.hpp"
#include "core/tolerances/dynamics.hpp"
#include "dynamics/blocks.hpp"

namespace yadefrag {
namespace {

using test::sameBits;

/// Splits nodes anywhere, without regard to what a crack would do.
struct Splitter {
  Model& model;
  std::mt19937_64 random;
  std::vector<std::vector<ElementId>> elementsOf = {};
  std::vector<ElementId> changed = {};
  std::vector<NodeId> originals = {};

  std::size_t any(std::size_t count) { return random() % count; }

  void list() {
    elementsOf.assign(model.nodes.size(), {});
    for (std::size_t e = 0; e < model.triangles.size(); ++e)
      for (const NodeId node : model.triangles.nodes[e]) elementsOf[node.value].emplace_back(e);
  }
  void begin() {
    changed.clear();
    originals.clear();
  }
  /// Some of the node's elements, but not all, get a new one.
  void split(NodeId node) {
    std::vector<ElementId> all = elementsOf[node.value];
    if (all.size() < 2) return;
    std::shuffle(all.begin(), all.end(), random);
    const auto kept = all.begin() + 1 + any(all.size() - 1);
    const NodeId added = model.nodes.duplicate(node);
    for (auto e = kept; e != all.end(); ++e) {
      auto& corners = model.triangles.nodes[e->value];
      std::replace(corners.begin(), corners.end(), node, added);
      changed.push_back(*e);
    }
    originals.push_back(node);
    elementsOf.emplace_back(kept, all.end());
    elementsOf[node.value].assign(all.begin(), kept);
  }
  /// As many splits, near one place or anywhere.
  void splitSome(std::size_t count, bool anywhere) {
    begin();
    const std::size_t first = any(model.triangles.size());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t e =
          anywhere ? any(model.triangles.size()) : std::min(first + i, model.triangles.size() - 1);
      split(model.triangles.nodes[e][any(3)]);
    }
    lumpMasses(model);
  }
};

/// 5000 triangles of one body and 600 of another, of which some nodes are held.
Model twoBlocks() {
  Model model = square(50);
  appendBlock(model, {.02, -.01}, {.03, .01}, 10, 30,
              {.young = 70e9, .poisson = .2, .density = 2700});
  shake(model, .5);
  model.nodes.load.assign(model.nodes.size(), {3, -2});
  for (std::size_t n = 0; n < model.nodes.size(); n += 97) {
    model.nodes.held[n] = 1 + n % 3;
    model.nodes.velocity[n] = {.1, -.2};
  }
  return model;
}

void checkSameAsRebuilt(const StepSettings& settings, int threads, int rounds, bool anywhere,
                        Model model = twoBlocks()) {
  const double dt = .2 * criticalTimeStep(model, settings.viscosity);
  ExplicitDynamics following;
  following.rebuild(model);
  following.predict(model, dt, settings, {}, threads);
  Splitter splitter{model, std::mt19937_64(threads)};
  splitter.list();
  for (int round = 0; round < rounds; ++round) {
    splitter.splitSome(1 + splitter.any(40), anywhere);
    following.follow(model, splitter.changed, splitter.originals);
    Model copy = model;
    ExplicitDynamics rebuilt;
    rebuilt.rebuild(copy);
    following.predict(model, dt, settings, {}, threads);
    rebuilt.predict(copy, dt, settings, {}, 1);
    ASSERT_TRUE(sameBits(model.nodes.position, copy.nodes.position)) << round;
    ASSERT_TRUE(sameBits(model.nodes.velocity, copy.nodes.velocity)) << round;
    ASSERT_TRUE(sameBits(following.internalForces(), rebuilt.internalForces())) << round;
    ASSERT_TRUE(sameBits(following.previousVelocity(), rebuilt.previousVelocity())) << round;
    EnergyLedger a;
    EnergyLedger b;
    following.finish(model, dt, settings, {}, {}, a, threads);
    rebuilt.finish(copy, dt, settings, {}, {}, b);
    ASSERT_EQ(a.external, b.external);
    ASSERT_EQ(a.damping, b.damping);
  }
  EXPECT_GT(model.nodes.size(), twoBlocks().nodes.size() + rounds);
}

TEST(Follow, StepsHaveTheBitsOfARebuiltSolver) {
  for (const int threads : {1, 2})
    for (const bool anywhere : {false, true}) checkSameAsRebuilt({}, threads, 60, anywhere);
}

TEST(Follow, StepsHaveTheBitsOfARebuiltSolverWithViscosity) {
  for (const int threads : {1, 2})
    checkSameAsRebuilt({.damping = 100, .viscosity = {.06, 1.2}}, threads, 60, true);
}

TEST(Follow, StepsHaveTheBitsOfARebuiltSolverWithSmoothedStrains) {
  for (const int threads : {1, 2}) {
    checkSameAsRebuilt({}, threads, 60, threads == 1, smoothed(twoBlocks()));
    Model mixed = twoBlocks();
    mixed.components[1].element = ElementKind::kSmoothed;
    checkSameAsRebuilt({.viscosity = {.06, 1.2}}, threads, 30, true, mixed);
  }
}

TEST(Follow, AMeshThatFallsIntoSingleTrianglesIsFollowed) {
  Model model = twoBlocks();
  const double dt = .2 * criticalTimeStep(model);
  ExplicitDynamics following;
  following.rebuild(model);
  Splitter splitter{model, std::mt19937_64(4)};
  splitter.list();
  while (model.nodes.size() < 3 * model.triangles.size()) {
    splitter.begin();
    const std::size_t nodes = model.nodes.size();
    for (std::size_t n = 0; n < nodes; ++n) splitter.split(NodeId(n));
    lumpMasses(model);
    following.follow(model, splitter.changed, splitter.originals);
    Model copy = model;
    ExplicitDynamics rebuilt;
    rebuilt.rebuild(copy);
    following.predict(model, dt, {}, {}, 2);
    rebuilt.predict(copy, dt, {}, {}, 1);
    ASSERT_TRUE(sameBits(model.nodes.position, copy.nodes.position));
    ASSERT_TRUE(sameBits(following.internalForces(), rebuilt.internalForces()));
  }
}

TEST(Follow, ViscosityMayComeAndGoBetweenSplits) {
  Model model = twoBlocks();
  const double dt = .2 * criticalTimeStep(model, {.06, 1.2});
  ExplicitDynamics following;
  following.rebuild(model);
  Splitter splitter{model, std::mt19937_64(8)};
  splitter.list();
  for (int round = 0; round < 40; ++round) {
    const StepSettings settings{.viscosity = {round % 3 == 0 ? 0 : .06, 0}};
    splitter.splitSome(30, true);
    following.follow(model, splitter.changed, splitter.originals);
    Model copy = model;
    ExplicitDynamics rebuilt;
    rebuilt.rebuild(copy);
    following.predict(model, dt, settings, {}, 1);
    rebuilt.predict(copy, dt, settings, {}, 1);
    ASSERT_TRUE(sameBits(following.internalForces(), rebuilt.internalForces())) << round;
  }
}

TEST(Follow, NewNodesTakeOverHowTheirOriginalsMoved) {
  Model model = twoBlocks();
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  dynamics.predict(model, .2 * criticalTimeStep(model), {}, {}, 1);
  Splitter splitter{model, std::mt19937_64(3)};
  splitter.list();
  const std::size_t firstNew = model.nodes.size();
  splitter.splitSome(200, true);
  dynamics.follow(model, splitter.changed, splitter.originals);
  const auto previous = dynamics.previousVelocity();
  ASSERT_EQ(previous.size(), model.nodes.size());
  for (std::size_t i = 0; i < splitter.originals.size(); ++i)
    EXPECT_EQ(previous[firstNew + i], previous[splitter.originals[i].value]);
}

TEST(Follow, OnlyChunksOfChangedElementsAreBuiltAnew) {
  Model model = twoBlocks();
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  Splitter splitter{model, std::mt19937_64(6)};
  splitter.list();
  for (int round = 0; round < 100; ++round) {
    splitter.splitSome(1, true);
    std::vector<std::size_t> chunks;  // those of the first body; the second begins one, too
    for (const ElementId e : splitter.changed)
      chunks.push_back(e.value < 5000 ? e.value / tolerance::kChunkElements
                                      : 100 + (e.value - 5000) / tolerance::kChunkElements);
    std::sort(chunks.begin(), chunks.end());
    const auto different = std::unique(chunks.begin(), chunks.end()) - chunks.begin();
    EXPECT_EQ(dynamics.follow(model, splitter.changed, splitter.originals), different);
    EXPECT_LE(different, 7);
  }
}

}  // namespace
}  // namespace yadefrag
