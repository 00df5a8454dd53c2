// The Brazilian disc: pressed between two flat plates until it splits. Along the diameter between
// two opposite line loads P the stress across it is 2P/(πDt) all the way (Hertz 1883), less only
// below the plates: the disc of a material that is strong in shear cracks there and then.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kRadius = .01, kStrength = 5e6;  // m, Pa

struct Split {
  bool cracked = false;
  double load = 0;     ///< 2P/(πDt) over the strength
  Vec2 at;             ///< of the first crack's middle, over the radius
  double turned = 0;   ///< rad, of the first crack from the loaded diameter
  double balance = 0;  ///< (P above − P below)/P
  double kinetic = 0;  ///< over the strain energy
};

/// (N) Contact force on a body, downwards.
double forceDown(const World& world, ComponentId on) {
  double sum = 0;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    if (world.model.nodes.component[i] == on) sum -= world.contact.forces()[i].y;
  return sum;
}

ComponentId addPlate(World& world, const ElasticMaterial& material, double y, double speed) {
  const TriangleMesh mesh =
      structuredRectangle({-kRadius / 2, y}, {kRadius / 2, y + kRadius / 10}, 4, 1);
  BodySpec spec = moving(mesh, material, {0, speed});
  hold(spec, mesh, kHeldXY, [](Vec2) { return true; });
  return world.addBody(mesh, spec);
}

/// With two poles.
Polygon discOf(double radius, double size) {
  const int corners = 4 * static_cast<int>(std::lround(std::numbers::pi * radius / size / 2));
  return {circle({}, radius, corners), {}};
}

/// `speed` (m/s) of either plate, `shearFactor` β.
Split press(double size, double speed, double shearFactor) {
  const ElasticMaterial material{2e9, .25, 2500, false};
  World world;
  // Vibrations decay in 0.1 ms; the pressing takes 1.5 ms.
  world.dynamicsSettings.damping = 2e4;
  const TriangleMesh mesh = triangulate(discOf(kRadius, size), size, {NodeLayout::kScattered, 1});
  BodySpec spec = moving(mesh, material, {0, 0});
  smoothAll(spec, mesh);
  spec.brittle.tensileStrength = kStrength;
  spec.brittle.shearFactor = shearFactor;
  world.addBody(mesh, spec);
  const ComponentId below = addPlate(world, material, -1.1 * kRadius, speed);
  const ComponentId above = addPlate(world, material, kRadius, -speed);
  const double dt = .8 * world.criticalTimeStep();
  while (world.fracture.numCracks() == 0 && world.time < .05 * kRadius / speed) world.step(dt);
  Split split;
  split.cracked = world.fracture.numCracks() > 0;
  const double down = forceDown(world, below), up = -forceDown(world, above);
  split.load = (down + up) / 2 / (std::numbers::pi * kRadius) / kStrength;
  split.balance = (down - up) / down;
  split.kinetic = world.kineticEnergy() / world.strainEnergy();
  if (!split.cracked) return split;
  const CrackLine crack = cracksOf(world).front();
  const Vec2 along = crack.last - crack.first;
  split.at = (1 / kRadius) * crack.middle();
  split.turned = std::atan2(std::abs(along.x), std::abs(along.y));
  return split;
}

class Brazilian : public testing::TestWithParam<double> {};

// Edges of an irregular mesh lie some degrees beside the diameter, where their traction is cos² of
// it; the others are what a node's mean stress and the plates' width leave. +0.1 to +1.4 %
// measured.
TEST_P(Brazilian, SplitsAlongTheLoadedDiameter) {
  const Split split = press(GetParam(), .1, 20);
  ASSERT_TRUE(split.cracked);
  figure("load", split.load, 1, .03);
  // Two elements, at least, and not below the plates.
  figure("beside_the_diameter", split.at.x, 0, std::max(.1, 2 * GetParam() / kRadius));
  figure("along_the_diameter", split.at.y, 0, .5);
  figure("turned", split.turned, 0, .3);
  // Pressed slowly: inertia plays no part but for what rings, of a thousandth.
  figure("balance", split.balance, 0, 2e-3);
  figure("kinetic_over_strain", split.kinetic, 0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Brazilian, testing::Values(8e-4, 6e-4, 4e-4, 3e-4));

TEST(Brazilian, TheLoadDoesNotDependOnTheSpeed) {
  const Split slow = press(6e-4, .05, 20), fast = press(6e-4, .1, 20);
  figure("slow_over_fast", slow.load / fast.load, 1, .005);
}

// Weak in shear, it fails below the plates long before: what the strength in shear is for.
TEST(Brazilian, AMaterialWeakInShearFailsAtThePlates) {
  const Split split = press(6e-4, .1, 3);
  ASSERT_TRUE(split.cracked);
  EXPECT_LT(split.load, .8);
  EXPECT_GT(std::abs(split.at.y), .8);
}

// --- The Brazilian disc between curved jaws: a pressure p on two opposite arcs of ±α. Across the
// loaded diameter the middle bears (2p/π)(sin 2α − α) (Hondros 1959, Aust. J. Appl. Sci. 10, 243),
// which is 2P/(πDt) for narrow arcs, and it is the place that bears most: so the disc splits from
// there even where the material is weak in shear.

constexpr double kBetweenJaws = .025, kArc = std::numbers::pi / 12;  // m, rad

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

Outcome pressArcs(const Trial& trial, double shearFactor) {
  BodySpec spec = rock();
  spec.brittle.shearFactor = shearFactor;
  spec.element = trial.element;
  const TriangleMesh mesh = trial.mesh(discOf(kBetweenJaws, trial.size));
  World world;
  world.addBody(mesh, spec);
  const double crossing =
      2 * kBetweenJaws / std::sqrt(spec.material.waveModulus() / spec.material.density);
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
  const auto cracks = cracksOf(world);
  outcome.at = cracks.empty() ? Vec2{NAN, NAN} : (1 / kBetweenJaws) * cracks.front().middle();
  return outcome;
}

class BrazilianArcs : public testing::TestWithParam<double> {};

/// Its tension falls by some per cent within a quarter of the radius only, so the first crack is
/// where an edge near the middle happens to lie along the diameter, and the load is above theory by
/// what the best of these edges lacks: +1.1 to +4.4 %, and at most 3 % with half the size.
TEST_P(BrazilianArcs, SplitFromTheMiddle) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Outcome outcome = pressArcs(withSeed(seed), GetParam());
    const std::string name = "_seed_" + std::to_string(seed);
    figure("load" + name, outcome.first, 1, .05);
    figure("from_the_middle" + name, norm(outcome.at), 0, .15);
  }
}

INSTANTIATE_TEST_SUITE_P(ShearFactors, BrazilianArcs, testing::Values(3., 20.));

TEST(BrazilianArcsMesh, FinerMeshesConvergeToTheTheory) {
  for (const double shearFactor : {3., 20.})
    for (const std::uint64_t seed : {1, 2, 3})
      figure("load", pressArcs({.625e-3, seed}, shearFactor).first, 1, .03);
}

TEST(BrazilianArcsMesh, RateElementAndRows) {
  Trial slow = kTrial, smoothed = kTrial, rows = kTrial;
  slow.crossings *= 2;
  smoothed.element = ElementKind::kSmoothed;
  rows.layout = NodeLayout::kRows;
  const double load = pressArcs(kTrial, 3).first;
  figure("slow_over_fast", pressArcs(slow, 3).first / load, 1, .005);
  figure("smoothed", pressArcs(smoothed, 3).first, 1, .05);
  figure("rows", pressArcs(rows, 3).first, 1, .05);
}

}  // namespace
}  // namespace yadefrag::test
