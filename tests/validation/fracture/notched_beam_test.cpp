// Three-point bending of a notched beam: how much more it bears than a cohesive crack that runs
// straight, over the number of elements in a cohesive zone E'Gc/ft².
//
//              ↓ P, prescribed speed
//    ┌─────────┬─────────┐
//    │         ╎ ligament│ D      notch 0.4 D, span 4 D, D = 8 E'Gc/ft²
//    │         │ notch   │
//    └△────────┴────────△┘

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "fracture/laboratory.hpp"

namespace yadefrag::test {
namespace {

constexpr double kDepth = .1, kNotch = .4, kHalfSpan = 2 * kDepth, kZone = kDepth / 8;  // m
constexpr double kHalfLength = kHalfSpan + kDepth / 10;                                 // m

/// The load of linear fracture mechanics is √(E'Gc)·D^1.5/(S·f), with f of Srawley 1976 (Int. J.
/// Fract. 12, 475). A straight crack with this cohesive law bears 0.897 of it: the fictitious crack
/// model (Hillerborg, Modéer and Petersson 1976) on 160 elements over the depth, quasi-static. The
/// asymptotic formula, a crack longer by 0.419 E'Gc/ft² (Planas and Elices 1991, Int. J. Fract. 51,
/// 139), gives 0.880.
constexpr double kSizeEffect = .897;

double theory(const BodySpec& spec, double young) {
  constexpr double a = kNotch;
  const double shape = 3 * std::sqrt(a) * (1.99 - a * (1 - a) * (2.15 - 3.93 * a + 2.7 * a * a)) /
                       (2 * (1 + 2 * a) * std::pow(1 - a, 1.5));
  return kSizeEffect * std::sqrt(young * spec.brittle.fractureEnergy) * std::pow(kDepth, 1.5) /
         (2 * kHalfSpan * shape);
}

/// `size` (m) around the ligament, three times as large far from it.
SizeField sizes(double size) {
  const auto points = [&](double length) {
    return static_cast<std::uint32_t>(std::ceil(length / size)) + 1;
  };
  const std::uint32_t columns = points(2 * kHalfLength);
  std::vector<double> values;
  for (std::uint32_t j = 0; j < points(kDepth); ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double aside = std::abs(i * size - kHalfLength) - std::max(4 * size, kDepth / 10);
      values.push_back(std::min(size + .2 * std::max(0., aside), 3 * size));
    }
  return {{-kHalfLength, 0}, size, columns, values};
}

struct Load {
  double most = 0, last = 0;  ///< N/m, means over a window of time: work over way
};

/// Until `end` (s), or until the load has fallen to a part of the largest one. `move` prescribes
/// the velocities of a window, and returns how fast (m/s) what is loaded parts.
template <class Move>
Load loadUntil(World& world, double end, double window, double part, Move move) {
  const double dt = .8 * world.criticalTimeStep();
  Load load;
  while (world.time < end && load.last >= part * load.most) {
    const double speed = move(world.time), before = world.ledger.external;
    double way = 0;
    for (const double until = world.time + window; world.time < until; way += speed * dt)
      world.step(dt);
    if (way > 0) load.last = (world.ledger.external - before) / way;
    load.most = std::max(load.most, load.last);
  }
  return load;
}

NodeId nodeAt(const World& world, Vec2 place) {
  for (std::size_t n = 0; n < world.model.nodes.reference.size(); ++n)
    if (norm(world.model.nodes.reference[n] - place) < 1e-9) return NodeId(n);
  ADD_FAILURE() << "no node at the place";
  return NodeId::none();
}

void addBeam(World& world, BodySpec& spec, double young, const Trial& trial) {
  const double ft = spec.brittle.tensileStrength, slit = trial.size / 20;
  spec.brittle.fractureEnergy = ft * ft * kZone / young;
  spec.element = trial.element;
  const Polygon outline{{{-kHalfLength, 0},
                         {-kHalfSpan, 0},
                         {-slit, 0},
                         {0, kNotch * kDepth},
                         {slit, 0},
                         {kHalfSpan, 0},
                         {kHalfLength, 0},
                         {kHalfLength, kDepth},
                         {0, kDepth},
                         {-kHalfLength, kDepth}},
                        {}};
  world.addBody(triangulate(outline, sizes(trial.size), {trial.layout, trial.seed}), spec);
  // Nothing cracks at the support and below the load.
  crackOnly(world, [](Vec2 x) { return std::abs(x.x) <= .3 * kDepth && x.y <= .9 * kDepth; });
}

/// Largest load over theory; `perZone` elements in a zone.
double strength(double perZone, Trial trial = {}) {
  trial.size = kZone / perZone;
  BodySpec spec = rock();
  spec.brittle.shearFactor = 1;
  const ElasticMaterial& m = spec.material;
  const double young = m.young / (1 - m.poisson * m.poisson);
  World world;
  addBeam(world, spec, young, trial);
  const double wanted = theory(spec, young);
  // Of the slowest vibration; the deflection at which an elastic beam of this notch bears `wanted`.
  const double period = 35 * kDepth / std::sqrt(m.young / m.density);
  const double deflection = 2.6 * 2 * std::pow(kHalfSpan / kDepth, 3) / young * wanted;
  const double duration = 5 * period, speed = deflection / duration;
  world.dynamicsSettings.damping = 1 / period;
  const std::vector<NodeId> load{nodeAt(world, {0, kDepth})};
  const std::vector<NodeId> supports{nodeAt(world, {-kHalfSpan, 0}), nodeAt(world, {kHalfSpan, 0})};
  world.prescribe(supports, kHeldY, {});
  const Load found = loadUntil(world, 4 * duration, period / 20, .8, [&](double time) {
    const double now = speed * std::min(1., time / (.2 * duration));
    world.prescribe(load, kHeldY, {0, -now});
    return now;
  });
  EXPECT_LT(found.last, .8 * found.most) << "it breaks";
  return found.most / wanted;
}

/// Wanted: 5 % with four elements. Of three meshes, it bears 4.1 to 4.7 % too much with four, 4.5
/// to 6.0 % with six, 2.0 to 12.2 % with eight; the path along edges, 1.05 times as long, makes up
/// for 2 %. By the mean stress around the tip alone it was 37 to 53 % with four.
TEST(NotchedBeam, FourElementsInAZoneDo) { figure("four_elements", strength(4), 1.05, .05); }

TEST(NotchedBeam, MoreElementsAndSeeds) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Trial trial;
    trial.seed = seed;
    const std::string name = "_elements_seed_" + std::to_string(seed);
    figure("four" + name, strength(4, trial), 1.05, .05);
    figure("six" + name, strength(6, trial), 1.05, .05);
    figure("eight" + name, strength(8, trial), 1.06, .07);
  }
}

TEST(NotchedBeam, RowsAndSmoothedStrains) {
  Trial rows, smoothed;
  rows.layout = NodeLayout::kRows;
  smoothed.element = ElementKind::kSmoothed;
  figure("rows", strength(4, rows), 1, .05);
  figure("smoothed", strength(4, smoothed), 1, .05);
}

// --- A square plate with a notch from the left side, pulled slowly: whatever way the mesh is
// turned, the crack goes straight across and the plate bears the same.
//
//    ↑ ↑ ↑ ↑ ↑ ↑    clamped, 30 × 30 mm, notch 12 mm, eight elements in a zone E'Gc/ft²
//    ┌─────────┐
//    ├───      │
//    └─────────┘
//    ↓ ↓ ↓ ↓ ↓ ↓

constexpr double kWide = .03, kCut = .012;  // m

struct Break {
  double load = 0;   ///< Pa, the largest, over the width
  double angle = 0;  ///< °, of the crack from the notch's tip to its far end
};

Break pull(const Trial& trial) {
  BodySpec spec = rock();
  spec.brittle.shearFactor = 1;
  spec.element = trial.element;
  const ElasticMaterial& m = spec.material;
  const double young = m.young / (1 - m.poisson * m.poisson), ft = spec.brittle.tensileStrength;
  spec.brittle.fractureEnergy = ft * ft * 8 * trial.size / young;
  const double half = kWide / 2;
  World world;
  world.addBody(trial.mesh(plateWithNotch({0, -half}, {kWide, half}, {kCut, 0}, trial.size)), spec);
  const double crossing = kWide / std::sqrt(m.waveModulus() / m.density);
  const double duration = trial.crossings * crossing;
  // Somewhat more than it takes.
  const double speed = 3 * ft / young * std::sqrt(8 * trial.size / kCut) * kWide / duration;
  world.dynamicsSettings.damping = 1 / crossing;
  const std::vector<NodeId> top = nodesAtHeight(world, half), bottom = nodesAtHeight(world, -half);
  Break outcome;
  outcome.load = loadUntil(world, 2 * duration, crossing / 4, .15,
                           [&](double time) {
                             const double now = speed * std::min(1., time / (.3 * duration));
                             world.prescribe(top, kHeldXY, {0, now / 2});
                             world.prescribe(bottom, kHeldXY, {0, -now / 2});
                             return now;
                           })
                     .most /
                 kWide;
  Vec2 far{kCut, 0};
  for (const CrackLine& edge : cracksOf(world, true))
    for (const Vec2 end : {edge.first, edge.last})
      if (end.x > far.x) far = end;
  EXPECT_GT(far.x, .85 * kWide) << "it breaks";
  outcome.angle = std::atan2(far.y, far.x - kCut) * 180 / std::numbers::pi;
  return outcome;
}

struct Spread {
  double steepest = 0;  ///< °
  double mean = 0;      ///< °, of all angles
  double most = 0, least = INFINITY;
};

Spread pullTurned(Trial trial, const std::vector<double>& turns) {
  trial.crossings = 60;
  Spread spread;
  for (const double turned : turns) {
    trial.turned = turned;
    const Break outcome = pull(trial);
    spread.steepest = std::max(spread.steepest, std::abs(outcome.angle));
    spread.mean += outcome.angle / static_cast<double>(turns.size());
    spread.most = std::max(spread.most, outcome.load);
    spread.least = std::min(spread.least, outcome.load);
  }
  return spread;
}

void expectAcross(const Spread& spread, double steepest, double loads) {
  figure("steepest", spread.steepest, 0, steepest);
  figure("mean_angle", spread.mean, 0, 2);
  figure("most_over_least", spread.most / spread.least, 1, loads);
}

/// Wanted: 3° and 3 %. Measured: 2.4° over 24 elements, 2.8 %.
TEST(TurnedPlate, CrackGoesAcross) {
  expectAcross(pullTurned({kWide / 40}, {0, 15, 30, 45}), 3, .03);
}

/// Over 36 elements, ten turns: 4.8°, the mean 0.8°, and the load scatters by 4.8 %. The crack goes
/// from one node to a next one, up to 30° aside, and is one or two elements beside the middle.
TEST(TurnedPlate, AllTurnsOfAFinerMesh) {
  expectAcross(pullTurned({kWide / 60}, {0, 5, 10, 15, 20, 25, 30, 35, 40, 45}), 5, .055);
}

}  // namespace
}  // namespace yadefrag::test
