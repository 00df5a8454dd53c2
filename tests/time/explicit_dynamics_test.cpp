// Waves, errors, and the same bits everywhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/blocks.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {
namespace {

/// A slender bar along x without lateral strain: its axial waves run at √(E/ρ).
Model bar(double length, int quads) {
  ElasticMaterial material = kSteel;
  material.poisson = 0;
  Model model;
  appendBlock(model, {0, 0}, {length, 2 * length / quads}, quads, 2, material);
  return model;
}

const double kBarSpeed = std::sqrt(kSteel.young / kSteel.density);

TEST(ExplicitDynamics, LowestAxialFrequencyOfABar) {
  const double length = .1;
  Model model = bar(length, 60);
  std::vector<double> shape;
  for (const Vec2 x : model.nodes.position)
    shape.push_back(std::cos(std::numbers::pi * x.x / length));
  for (std::size_t n = 0; n < shape.size(); ++n) model.nodes.velocity[n] = {1e-3 * shape[n], 0};
  Stepper run = runOf(std::move(model), .9);
  const auto amplitude = [&] {
    double sum = 0;
    for (std::size_t n = 0; n < shape.size(); ++n)
      sum += run.model.nodes.mass[n] * shape[n] * run.model.nodes.velocity[n].x;
    return sum;
  };
  // The tenth change of sign comes after 9½ half periods L/c. Velocities are those half a step
  // back.
  double now = amplitude();
  double time = -run.dt / 2;
  for (int changes = 0; changes < 10; time += run.dt) {
    const double before = now;
    run.step();
    now = amplitude();
    if (now * before < 0 && ++changes == 10) time -= run.dt * now / (now - before);
  }
  // Linear elements, 60 of them: (πh/L)²/24 = 10⁻⁴; some more on a mesh that is not regular.
  EXPECT_NEAR(time / (9.5 * length / kBarSpeed), 1, 1e-3);
}

TEST(ExplicitDynamics, AStepOfVelocityRunsAtTheWaveSpeed) {
  const double length = .1;
  Model model = bar(length, 200);
  std::size_t middle = 0;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Vec2 x = model.nodes.position[n];
    if (x.x == 0) {
      model.nodes.held[n] = kHeldX;
      model.nodes.velocity[n] = {1, 0};
    }
    if (x.y == 0 && std::abs(x.x - length / 2) < 1e-6) middle = n;
  }
  Stepper run = runOf(std::move(model), .9);
  double time = 0;
  // A front that spreads by dispersion has a third of its height where it would be without.
  for (; run.model.nodes.velocity[middle].x < 1. / 3; time += run.dt) run.step();
  EXPECT_NEAR(time * kBarSpeed / (length / 2), 1, .005);  // half an element
}

TEST(ExplicitDynamics, TheSameBitsForAnyInstructionSet) {
  Model model = square(70);
  ElasticMaterial soft = kSteel;
  soft.young /= 7;
  appendBlock(model, {.02, 0}, {.03, .03}, 30, 31, soft);
  appendBlock(model, {.04, 0}, {.05, .03}, 3, 5, soft);
  shake(model, 5);
  for (const Model& one : {model, smoothed(model)})
    expectSameForAnySet(one, .5, 40,
                        {.damping = 10, .gravity = {0, -9.81}, .viscosity = {.06, 1.2}});
}

// --- Nodes that split: what the dynamics follow has the same bits as what is built from scratch.

using test::sameBits;

/// Splits nodes anywhere, without regard to what a crack would do.
struct Splitter {
  Model& model;
  std::mt19937_64 random;
  std::vector<ElementId> changed = {};
  std::vector<NodeId> originals = {};

  std::size_t any(std::size_t count) { return random() % count; }

  /// Some of the node's elements, but not all, get a new one.
  void split(NodeId node) {
    std::vector<ElementId> all;
    for (std::size_t e = 0; e < model.triangles.size(); ++e)
      if (std::ranges::count(model.triangles.nodes[e], node) > 0) all.emplace_back(e);
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
  }
  /// As many splits, near one place or anywhere.
  void splitSome(std::size_t count, bool anywhere) {
    changed.clear();
    originals.clear();
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
  for (int round = 0; round < rounds; ++round) {
    splitter.splitSome(1 + splitter.any(40), anywhere);
    following.follow(model, splitter.changed, splitter.originals);
    // New nodes take over how their originals moved.
    const auto previous = following.previousVelocity();
    ASSERT_EQ(previous.size(), model.nodes.size());
    const std::size_t firstNew = previous.size() - splitter.originals.size();
    for (std::size_t i = 0; i < splitter.originals.size(); ++i)
      ASSERT_EQ(previous[firstNew + i], previous[splitter.originals[i].value]);
    Model copy = model;
    ExplicitDynamics rebuilt;
    rebuilt.rebuild(copy);
    StepSettings now = settings;
    if (round % 3 == 0) now.viscosity = {};  // it may come and go
    following.predict(model, dt, now, {}, threads);
    rebuilt.predict(copy, dt, now, {}, 1);
    ASSERT_TRUE(sameBits(model.nodes.position, copy.nodes.position)) << round;
    ASSERT_TRUE(sameBits(model.nodes.velocity, copy.nodes.velocity)) << round;
    ASSERT_TRUE(sameBits(following.internalForces(), rebuilt.internalForces())) << round;
    ASSERT_TRUE(sameBits(following.previousVelocity(), rebuilt.previousVelocity())) << round;
    EnergyLedger a;
    EnergyLedger b;
    following.finish(model, dt, now, {}, {}, a, threads);
    rebuilt.finish(copy, dt, now, {}, {}, b);
    ASSERT_EQ(a.external, b.external);
    ASSERT_EQ(a.damping, b.damping);
  }
  EXPECT_GT(model.nodes.size(), twoBlocks().nodes.size() + rounds);
}

TEST(Follow, StepsHaveTheBitsOfARebuiltSolver) {
  Model mixed = twoBlocks();
  mixed.components[1].element = ElementKind::kSmoothed;
  for (const int threads : {1, 2}) {
    for (const bool anywhere : {false, true}) checkSameAsRebuilt({}, threads, 60, anywhere);
    checkSameAsRebuilt({.damping = 100, .viscosity = {.06, 1.2}}, threads, 60, true);
    checkSameAsRebuilt({}, threads, 60, threads == 1, smoothed(twoBlocks()));
    checkSameAsRebuilt({.viscosity = {.06, 1.2}}, threads, 30, true, mixed);
  }
}

TEST(Follow, OnlyChunksOfChangedElementsAreBuiltAnew) {
  Model model = twoBlocks();
  ExplicitDynamics dynamics;
  dynamics.rebuild(model);
  Splitter splitter{model, std::mt19937_64(6)};
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
