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

#include "fracture/laboratory.hpp"
#include "step/figures.hpp"

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

NodeId nodeAt(const World& world, Vec2 place) {
  for (std::size_t n = 0; n < world.model.nodes.reference.size(); ++n)
    if (norm(world.model.nodes.reference[n] - place) < 1e-9) return NodeId(n);
  ADD_FAILURE() << "no node at the place";
  return NodeId::none();
}

/// Nothing cracks at the support and below the load.
void crackOnlyLigament(World& world) {
  CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec2 at =
        world.model.nodes.reference[firstNode(world.model, edges.side(EdgeId(i), 0)).value];
    if (std::abs(at.x) > .3 * kDepth || at.y > .9 * kDepth) edges.strength[i] = INFINITY;
  }
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
  crackOnlyLigament(world);
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
  const double dt = .8 * world.criticalTimeStep();
  double most = 0, last = 0;
  while (world.time < 4 * duration && last >= .8 * most) {
    const double now = speed * std::min(1., world.time / (.2 * duration));
    world.prescribe(load, kHeldY, {0, -now});
    const double before = world.ledger.external;
    double way = 0;
    for (const double end = world.time + period / 20; world.time < end; way += now * dt)
      world.step(dt);
    last = way > 0 ? (world.ledger.external - before) / way : 0;
    most = std::max(most, last);
  }
  EXPECT_LT(last, .8 * most) << "it breaks";
  return most / wanted;
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

}  // namespace
}  // namespace yadefrag::test
