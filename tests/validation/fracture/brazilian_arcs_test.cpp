// The Brazilian disc between curved jaws: a pressure p on two opposite arcs of ±α. Across the
// loaded diameter the middle bears (2p/π)(sin 2α − α) (Hondros 1959, Aust. J. Appl. Sci. 10, 243),
// which is 2P/(πDt) for narrow arcs, and it is the place that bears most: so the disc splits from
// there even where the material is weak in shear.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fracture/laboratory.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kRadius = .025, kArc = std::numbers::pi / 12;  // m, rad

constexpr Trial kTrial{.size = 1.25e-3, .crossings = 50};

Trial withSeed(std::uint64_t seed) {
  Trial trial = kTrial;
  trial.seed = seed;
  return trial;
}

struct Outcome {
  double first = 0;  ///< load at the first crack, over Hondros'
  Vec2 at;           ///< its middle, over the radius
};

TriangleMesh discOf(const Trial& trial) {
  const int corners =
      4 * static_cast<int>(std::lround(std::numbers::pi * kRadius / trial.size / 2));
  Polygon polygon;
  for (int k = 0; k < corners; ++k)
    polygon.outline.push_back(turnedBy({kRadius, 0}, 2 * std::numbers::pi * k / corners));
  return trial.mesh(polygon);
}

/// (N/Pa) Nodal forces of a pressure of 1 Pa on both arcs.
std::vector<Vec2> unitLoads(const TriangleMesh& mesh) {
  constexpr int kPoints = 100;  // along a side, of which a part may be loaded
  std::vector<Vec2> loads(mesh.nodes.size());
  const auto& loop = mesh.loops[0];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
    const Vec2 along = mesh.nodes[b] - mesh.nodes[a];
    for (int i = 0; i < kPoints; ++i) {
      const double share = (i + .5) / kPoints;
      const Vec2 x = mesh.nodes[a] + share * along;
      if (std::atan2(std::abs(x.x), std::abs(x.y)) > kArc) continue;
      const Vec2 force = (-norm(along) / kPoints / norm(x)) * x;
      loads[a] += (1 - share) * force;
      loads[b] += share * force;
    }
  }
  return loads;
}

Outcome press(const Trial& trial, double shearFactor) {
  BodySpec spec = rock();
  spec.brittle.shearFactor = shearFactor;
  spec.element = trial.element;
  const TriangleMesh mesh = discOf(trial);
  World world;
  world.addBody(mesh, spec);
  const double crossing =
      2 * kRadius / std::sqrt(spec.material.waveModulus() / spec.material.density);
  world.dynamicsSettings.damping = 1 / crossing;
  const double dt = .8 * world.criticalTimeStep();
  const double strongest =
      spec.brittle.tensileStrength * std::numbers::pi / 2 / (std::sin(2 * kArc) - kArc);
  const std::vector<Vec2> unit = unitLoads(mesh);
  Outcome outcome;
  while (world.fracture.numCracks() == 0 && outcome.first < 1.5) {
    outcome.first = world.time / (trial.crossings * crossing);
    std::vector<Vec2> loads = unit;
    for (Vec2& load : loads) load *= outcome.first * strongest;
    world.setLoads(loads);
    world.step(dt);
  }
  outcome.at = (1 / kRadius) * firstCrack(world);
  return outcome;
}

class BrazilianArcs : public testing::TestWithParam<double> {};

/// Its tension falls by some per cent within a quarter of the radius only, so the first crack is
/// where an edge near the middle happens to lie along the diameter, and the load is above theory by
/// what the best of these edges lacks: +1.1 to +4.4 %, and at most 3 % with half the size.
TEST_P(BrazilianArcs, SplitFromTheMiddle) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Outcome outcome = press(withSeed(seed), GetParam());
    const std::string name = "_seed_" + std::to_string(seed);
    figure("load" + name, outcome.first, 1, .05);
    figure("from_the_middle" + name, norm(outcome.at), 0, .15);
  }
}

INSTANTIATE_TEST_SUITE_P(ShearFactors, BrazilianArcs, testing::Values(3., 20.));

TEST(BrazilianArcsMesh, FinerMeshesConvergeToTheTheory) {
  for (const double shearFactor : {3., 20.})
    for (const std::uint64_t seed : {1, 2, 3})
      figure("load", press({.625e-3, seed}, shearFactor).first, 1, .03);
}

TEST(BrazilianArcsMesh, RateElementAndRows) {
  Trial slow = kTrial, smoothed = kTrial, rows = kTrial;
  slow.crossings *= 2;
  smoothed.element = ElementKind::kSmoothed;
  rows.layout = NodeLayout::kRows;
  const double load = press(kTrial, 3).first;
  figure("slow_over_fast", press(slow, 3).first / load, 1, .005);
  figure("smoothed", press(smoothed, 3).first, 1, .05);
  figure("rows", press(rows, 3).first, 1, .05);
}

}  // namespace
}  // namespace yadefrag::test
