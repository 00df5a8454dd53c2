// A block of rock between two platens that slide sideways without friction: the stress is uniform,
// and the load that it bears is Mohr's and Coulomb's, σ₁ = 2c cos φ/(1 − sin φ) + σ₃(1 + sin φ)/(1
// − sin φ).  ↓ ↓ ↓ ↓        platens: nodes that move at a prescribed speed, up and down, and are
// free →┌───────┐←      sideways σ₃ →│       │← σ₃   nodal forces that do not change →└───────┘← ↑
// ↑ ↑ ↑        20 × 40 mm The Brazilian disc: pressed between two flat plates until it splits.
// Along the diameter between two opposite line loads P the stress across it is 2P/(πDt) all the way
// (Hertz 1883), less only below the plates: the disc of a material that is strong in shear cracks
// there and then.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "fracture/laboratory.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kWide = .02, kHigh = .04, kSize = 1.25e-3;  // m

struct RunResult {
  double first = 0;      ///< load at the first crack, over Mohr's and Coulomb's
  double peak = 0;       ///< the largest load, over the same
  double last = 0;       ///< at the end, over the same
  double shortened = 0;  ///< at the end, over what the elastic block would be at failure
};

/// From the uniform stress `confining` on, the block gets shorter at a constant rate, and wider as
/// the elastic block would: no wave disturbs it before it cracks.
class Press {
 public:
  Press(const Trial& trial, const BodySpec& rock, double confining);
  /// Until the load is below `least` of Mohr's and Coulomb's after the first crack, or the platens
  /// have gone `way` times as far as the elastic block does until it fails.
  RunResult run(double way, double least);

 private:
  [[nodiscard]] double axialWork() const;

  World world_;
  double failure_;   // Pa
  double rate_ = 0;  // 1/s
  double crossing_;  // s, of a wave
  double elastic_;   // s, until the elastic block fails
};

Press::Press(const Trial& trial, const BodySpec& rock, double confining)
    : failure_(mohrCoulomb(rock, confining)) {
  const TriangleMesh mesh = trial.mesh(rectangle({0, 0}, {kWide, kHigh}));
  BodySpec spec = rock;
  spec.element = trial.element;
  const ElasticMaterial& m = spec.material;
  const double young = m.young / (1 - m.poisson * m.poisson);  // of plane strain
  const double poisson = m.poisson / (1 - m.poisson);
  crossing_ = kHigh / std::sqrt(m.waveModulus() / m.density);
  elastic_ = trial.crossings * crossing_;
  rate_ = (failure_ - confining) / young / elastic_;
  for (const Vec2 node : mesh.nodes) {
    const Vec2 x = node - Vec2{kWide / 2, kHigh / 2};
    spec.displacement.push_back(-(1 - poisson) * confining / young * x);
    spec.velocity.push_back({poisson * rate_ * x.x, -rate_ * x.y});
  }
  world_.addBody(mesh, spec);
  for (const double end : {0., 1.})
    world_.prescribe(nodesAtHeight(world_, end * kHigh), kHeldY, {0, (.5 - end) * rate_ * kHigh});
  if (confining > 0) {
    std::vector<Vec2> loads(mesh.nodes.size());
    for (const double side : {0., kWide})
      addTraction(
          mesh, {side > 0 ? -confining : confining, 0},
          [=](Vec2 x) { return std::abs(x.x - side) < 1e-9; }, loads);
    world_.setLoads(loads);
  }
  // Fragments calm down; it takes half a per mille of the load until then.
  world_.dynamicsSettings.damping = .2 / crossing_;
}

/// (J) What the platens have put in: all outer work but that of the constant lateral forces.
double Press::axialWork() const {
  double lateral = 0;
  const Nodes& nodes = world_.model.nodes;
  for (std::size_t n = 0; n < nodes.load.size(); ++n)
    lateral += dot(nodes.load[n], nodes.position[n]);
  return world_.ledger.external - lateral;
}

RunResult Press::run(double way, double least) {
  const double dt = .8 * world_.criticalTimeStep();
  const int every = static_cast<int>(crossing_ / dt / 4);
  RunResult result;
  double before = axialWork();
  while (result.shortened < way) {
    for (int k = 0; k < every; ++k) world_.step(dt);
    const double work = axialWork();
    result.last = (work - before) / (rate_ * kHigh * every * dt * kWide) / failure_;
    before = work;
    result.shortened = world_.time / elastic_;
    result.peak = std::max(result.peak, result.last);
    if (world_.fracture.numCracks() == 0) continue;
    if (result.first == 0) result.first = result.last;
    if (result.last < least) break;
  }
  return result;
}

RunResult uniaxial(const Trial& trial) { return Press(trial, rock(), 0).run(1.3, .2); }

/// The first crack is at the load of theory, since some edge lies along the worst plane, to a few
/// degrees. It brings about the collapse, and the load still rises until the waves of it arrive.
constexpr double kFirst = .005, kPeak = .02;

void expectPeakAndCollapse(const RunResult& result) {
  figure("peak", result.peak, 1, kPeak);
  figure("first_crack", result.first, 1, kFirst);
  EXPECT_LT(result.last, .2) << "it collapses";
  record("shortened", result.shortened);
}

TEST(Uniaxial, TheLoadIsTheSameHoweverTheOutlineIsTurned) {
  double least = INFINITY, most = 0;
  for (const double turned : {0., 15., 30.}) {
    const RunResult result = uniaxial({kSize, 1, turned});
    expectPeakAndCollapse(result);
    least = std::min(least, result.peak), most = std::max(most, result.peak);
  }
  figure("most_over_least", most / least, 1, .005);
}

/// Twice as slow: the load is that of a block at rest.
TEST(Uniaxial, TheRateDoesNotMatter) {
  Trial slow{kSize};
  slow.crossings *= 2;
  figure("slow_over_fast", uniaxial(slow).peak / uniaxial({kSize}).peak, 1, .003);
}

TEST(Uniaxial, RowsAndSmoothedStrainsCarryTheSame) {
  Trial rows{kSize}, smoothed{kSize};
  rows.layout = NodeLayout::kRows;
  smoothed.element = ElementKind::kSmoothed;
  expectPeakAndCollapse(uniaxial(rows));
  expectPeakAndCollapse(uniaxial(smoothed));
}

TEST(Uniaxial, AllMeshes) {
  for (const double size : {2e-3, kSize, .8e-3})
    for (const std::uint64_t seed : {1, 2, 3})
      for (const double turned : {0., 15., 30.}) {
        SCOPED_TRACE(testing::Message() << size << " m, seed " << seed << ", " << turned << "°");
        expectPeakAndCollapse(uniaxial({size, seed, turned}));
      }
}

class BiaxialPressure : public testing::TestWithParam<double> {};

/// Up to a lateral pressure of ft: 0.0 to +2.5 %. It does not fall to the friction of smooth faces
/// afterwards, a quarter of the peak at 5 MPa, but to 0.6 to 0.9: see the next test.
TEST_P(BiaxialPressure, CarriesTheMohrCoulombLoad) {
  for (const std::uint64_t seed : {1, 2}) {
    const RunResult result = Press({1.6e-3, seed}, rock(), GetParam()).run(1.1, .5);
    figure("peak", result.peak, 1, .04);
    figure("first_crack", result.first, 1, kFirst);
    EXPECT_LT(result.last, .9) << "the load falls";
  }
}

INSTANTIATE_TEST_SUITE_P(Pressures, BiaxialPressure, testing::Values(1e6, 2.5e6, 5e6));

/// Wanted: 5 %. At 3 ft it begins to crack at the load of theory, too, but the load then rises on,
/// at 1.25 times the shortening to +10 to +13 %: faces that zigzag by ±i slide at the angle φ + i
/// (Patton 1966, Proc. 1st Congr. ISRM, 509). With i ≈ 17°, as irregular edges have it, such rubble
/// bears 8.2 σ₃, more than the whole block where σ₃ > 12 MPa.
TEST(Biaxial, UnderHighPressureItYieldsThereAndHardens) {
  const RunResult result = Press({2e-3}, rock(), 15e6).run(1.25, .5);
  figure("first_crack", result.first, 1, kFirst);
  figure("peak", result.peak, 1.1, .05);
  figure("last", result.last, 1.1, .1);
}

constexpr double kRadius = .01, kStrength = 5e6;  // m, Pa

struct Split {
  bool cracked = false;
  double load = 0;     ///< 2P/(πDt) over the strength
  Vec2 at;             ///< of the first crack's middle, over the radius
  double turned = 0;   ///< rad, of the first crack from the loaded diameter
  double balance = 0;  ///< (P above − P below)/P
  double kinetic = 0;  ///< over the strain energy
};

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
  BodySpec spec = brittle(material, kStrength);
  smoothAll(spec, mesh);
  spec.brittle.shearFactor = shearFactor;
  world.addBody(mesh, spec);
  const ComponentId below = addPlate(world, material, -1.1 * kRadius, speed);
  const ComponentId above = addPlate(world, material, kRadius, -speed);
  const double dt = .8 * world.criticalTimeStep();
  while (world.fracture.numCracks() == 0 && world.time < .05 * kRadius / speed) world.step(dt);
  Split split;
  split.cracked = world.fracture.numCracks() > 0;
  const double down = -contactForce(world, below).y, up = contactForce(world, above).y;
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
