// Bars that meet head on: the contact problem with a closed form for all of its course. With ν = 0
// and the lateral faces held in y, waves run along x at c = √(E/ρ) and carry the stress ρcv.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/checks.hpp"
#include "core/tolerances/contact.hpp"
#include "elements/element_state.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kHeight = .004;  // m, of all bars
constexpr double kLength = .1;    // m

double waveSpeed(const ElasticMaterial& m) { return std::sqrt(m.waveModulus() / m.density); }
double impedance(const ElasticMaterial& m) { return m.density * waveSpeed(m); }

ComponentId addBar(World& world, const ElasticMaterial& material, double speed, double begin,
                   double end, int nx, int ny, QuadPattern pattern = QuadPattern::kUnionJack) {
  const TriangleMesh mesh = structuredRectangle({begin, 0}, {end, kHeight}, nx, ny, pattern);
  BodySpec spec = moving(mesh, material, {speed, 0});
  hold(spec, mesh, kHeldY, [](Vec2 at) { return at.y < 1e-9 || at.y > kHeight - 1e-9; });
  return world.addBody(mesh, spec);
}

/// Values by step.
struct Record {
  std::vector<double> time, value;

  [[nodiscard]] std::vector<double> between(double from, double to) const {
    std::vector<double> some;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] > from && time[i] < to) some.push_back(value[i]);
    return some;
  }
  [[nodiscard]] double mean(double from, double to) const {
    const std::vector<double> some = between(from, to);
    return std::accumulate(some.begin(), some.end(), 0.) / static_cast<double>(some.size());
  }
  /// (s) From the first value above 0 to the last.
  [[nodiscard]] double duration() const {
    double first = -1, last = -1;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (value[i] > 0) first = first < 0 ? time[i] : first, last = time[i];
    return last - first;
  }
};

/// (Pa) Contact force on a body over the height.
double contactStress(const World& world, ComponentId on) {
  return std::abs(contactForce(world, on).x) / kHeight;
}

Record contactUntil(World& world, ComponentId on, double until) {
  Record record;
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < until) {
    world.step(dt);
    record.time.push_back(world.time);
    record.value.push_back(contactStress(world, on));
  }
  return record;
}

/// Mean and ripple over the middle of the plateau, 0.6 to 1.4 L/c of its 2L/c: nearer to its ends
/// the mesh's own ringing behind a step (Gibbs) is in it.
void expectPlateau(const Record& force, double travel, double stress, double mostRipple = .03) {
  const double mean = force.mean(.6 * travel, 1.4 * travel);
  double ripple = 0;
  for (const double value : force.between(.6 * travel, 1.4 * travel))
    ripple = std::max(ripple, std::abs(value / mean - 1));
  figure("mean_over_closed_form", mean / stress, 1, .005);
  figure("ripple", ripple, 0, mostRipple);
  figure("duration_over_2L_c", force.duration() / (2 * travel), 1, .01);
}

void equalBars(QuadPattern pattern, double mostRipple) {
  const double v = 1;
  const ElasticMaterial material = steel(0);
  const double travel = kLength / waveSpeed(material);
  World world;
  const ComponentId a = addBar(world, material, v / 2, -kLength, 0, 100, 4, pattern);
  const ComponentId b = addBar(world, material, -v / 2, 0, kLength, 100, 4, pattern);
  const double before = totalEnergy(world);
  const Record force = contactUntil(world, b, 3 * travel);

  expectPlateau(force, travel, impedance(material) * v / 2, mostRipple);
  // A bar keeps the waves behind its front: less than an element's share of the momentum.
  figure("speed_of_a", meanVelocity(world, a).x / (v / 2), -1, .015);
  figure("speed_of_b", meanVelocity(world, b).x / (v / 2), 1, .015);
  figure("energy_error", totalEnergy(world) / before - 1, 0, .002);
  // What the nodes of both faces lose when they meet, some half an element's mass: it is counted.
  figure("energy_lost_at_touch", world.ledger.contact / before, 0, .006);
}

TEST(Bars, EqualBarsExchangeTheirVelocities) { equalBars(QuadPattern::kCrossed, .03); }
// The union jack lumps masses unevenly and rings a little more: 3.08 %.
TEST(Bars, EqualBarsOfUnionJacksExchangeTheirVelocities) {
  equalBars(QuadPattern::kUnionJack, .032);
}

TEST(Bars, ABarReboundsFromARigidWall) {
  const double v = 1;
  const ElasticMaterial material = steel(0);
  const double travel = kLength / waveSpeed(material);
  World world;
  const ComponentId bar = addBar(world, material, -v, 0, kLength, 100, 4, QuadPattern::kCrossed);
  const TriangleMesh mesh = structuredRectangle({-.01, -.003}, {0, .007}, 5, 7);
  BodySpec wall = moving(mesh, material, {0, 0});
  hold(wall, mesh, kHeldXY, [](Vec2) { return true; });
  world.addBody(mesh, wall);
  const double before = totalEnergy(world);
  const Record force = contactUntil(world, bar, 3 * travel);

  expectPlateau(force, travel, impedance(material) * v);
  figure("rebound", meanVelocity(world, bar).x / v, 1, .02);
  figure("energy_error", totalEnergy(world) / before - 1, 0, .002);
}

/// (Pa) −σxx of a body's elements within 2 mm of a cross-section, weighted by area.
double sectionStress(const World& world, ComponentId of, double at) {
  const auto all = stresses(world.model);
  double sum = 0, area = 0;
  for (std::size_t e = 0; e < all.size(); ++e) {
    if (world.model.triangles.component[e] != of) continue;
    if (std::abs(middleOf(world, e).x - at) > .002) continue;
    sum -= all[e][0] * world.model.triangles.area[e];
    area += world.model.triangles.area[e];
  }
  return sum / area;
}

// A short bar of tungsten on a long one of titanium. The impact sends the stress s = Z₁Z₂v/(Z₁+Z₂)
// into both. In the short bar it comes back from the free end as a release −s, which meets the
// interface at 2L₁/c₁: r = (Z₂−Z₁)/(Z₂+Z₁) of it is reflected, 1 + r transmitted, and since Z₁ > Z₂
// the bars stay together on −rs, then on r²s.
TEST(Bars, StressIsReflectedAndTransmittedByTheRatioOfImpedances) {
  const ElasticMaterial heavy{400e9, 0, 19000, false}, light{110e9, 0, 4500, false};
  const double z1 = impedance(heavy), z2 = impedance(light), v = 1;
  const double s = z1 * z2 / (z1 + z2) * v, r = (z2 - z1) / (z2 + z1);
  const double shortLength = .06, c1 = waveSpeed(heavy), c2 = waveSpeed(light);
  World world;
  const ComponentId first = addBar(world, heavy, v, -shortLength, 0, 120, 4);
  const ComponentId second = addBar(world, light, 0, 0, .25, 350, 6);

  const double round = 2 * shortLength / c1, in1 = -.5 * shortLength, in2 = .02;
  Record inFirst, inSecond, contact;
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < 3 * round) {
    world.step(dt);
    for (Record* record : {&inFirst, &inSecond, &contact}) record->time.push_back(world.time);
    inFirst.value.push_back(sectionStress(world, first, in1));
    inSecond.value.push_back(sectionStress(world, second, in2));
    contact.value.push_back(contactStress(world, second));
  }
  // The middle of each plateau; waves pass the middle of the short bar twice in each round.
  const double late = in2 / c2;
  const auto second_ = [&](int n) {
    return inSecond.mean((n + .25) * round + late, (n + .85) * round + late);
  };
  const auto contact_ = [&](int n) { return contact.mean((n + .2) * round, (n + .8) * round); };
  const auto first_ = [&](double n) { return inFirst.mean((n - .15) * round, (n + .15) * round); };
  const double incident = first_(1) - first_(.5);  // the release

  figure("impact_stress", second_(0) / s, 1, .01);
  figure("impact_stress_in_first", first_(.5) / s, 1, .01);
  figure("released_in_first", first_(1) / s, 0, .01);
  figure("reflected", (first_(1.5) - first_(1)) / incident / r, 1, .01);
  figure("transmitted", (second_(1) - second_(0)) / incident / (1 + r), 1, .01);
  figure("second_reflection", second_(2) / second_(1) / -r, 1, .01);
  figure("contact_after_release", contact_(1) / contact_(0) / -r, 1, .01);
}

// --- Blocks that touch exactly, with friction and gravity: nearly all rows are redundant, and one
// group has hundreds of them. Exact solves for given bounds of friction took 1 s a step for 36
// blocks.

class TouchingBlocks : public testing::TestWithParam<int> {
 protected:
  void build(const BlockWall& wall) {
    world_.contactSettings.passes = GetParam();
    addBlockWall(world_, wall);
    dt_ = .8 * world_.criticalTimeStep();
  }
  World world_;
  double dt_ = 0;
};

/// From the first step on, and while waves of gravity's onset go through the wall.
TEST_P(TouchingBlocks, AreSolvedInFewSweeps) {
  build({6});
  int most = 0;
  std::uint64_t sum = 0;
  std::size_t rows = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    world_.step(dt_);
    most = std::max(most, world_.contact.sweeps());
    sum += static_cast<std::uint64_t>(world_.contact.sweeps());
    rows = std::max(rows, world_.contact.rows().size());
  }
  EXPECT_GE(rows, 200U);  // those with a force
  record("most_sweeps_in_a_step", most);
  record("mean_sweeps_in_a_step", double(sum) / kSteps);
  EXPECT_LE(most, 2 * tolerance::Contact().rowSweeps);
  EXPECT_LT(double(sum) / kSteps, 40);
  EXPECT_TRUE(world_.warnings.empty());
}

/// The floor carries what the blocks weigh, once damping has brought them to rest.
TEST_P(TouchingBlocks, StandOnTheirFloor) {
  build({3});
  // Near the critical damping of the wall's lowest vertical mode, c/4H: it rests soonest.
  const double speed = std::sqrt(30e9 / 2500), height = 3 * kBlockSide;
  world_.dynamicsSettings.damping = 3.14 * speed / height;
  while (world_.time < 20 * height / speed) world_.step(dt_);
  const ComponentId floor(0);
  const std::vector<double>& masses = world_.model.nodes.mass;
  const double pushed = -contactForce(world_, floor).y;
  const double weight =
      9.81 * (std::accumulate(masses.begin(), masses.end(), 0.) - mass(world_, floor));
  // A ten-thousandth: what is left of the wall's oscillation by then.
  figure("force_on_the_floor_over_weight", pushed / weight, 1, 1e-3);
}

/// A joint that is closed from the start and one that closes in the first steps are the same joint:
/// gravity does the same work until the wall swings back.
TEST_P(TouchingBlocks, TakeTheEnergyOfBlocksAHairApart) {
  build({4});
  World apart = inPasses(GetParam());
  addBlockWall(apart, {4, 1e-10});
  const auto energy = [](const World& world) {
    return world.kineticEnergy() + world.strainEnergy();
  };
  double most = 0, mostApart = 0;
  for (int i = 0; i < 200; ++i) {
    world_.step(dt_), apart.step(dt_);
    most = std::max(most, energy(world_)), mostApart = std::max(mostApart, energy(apart));
  }
  // Joints that open and close lose what their nodes bring; when they do so differs.
  figure("largest_energy_over_that_of_blocks_apart", most / mostApart, 1, .03);
}

/// Joints that stay open cost no detection. Those that close are looked at in time: SameBits.
TEST_P(TouchingBlocks, AreNotLookedAtWhileTheyAreApart) {
  build({4, 5e-5});
  world_.step(dt_);
  const double first = world_.contact.candidates.nearest.when;
  for (int i = 0; i < 50; ++i) world_.step(dt_);
  EXPECT_EQ(world_.contact.candidates.nearest.when, first);
  EXPECT_FALSE(world_.contact.candidates.distances.empty());
}

INSTANTIATE_TEST_SUITE_P(Passes, TouchingBlocks, testing::Values(1, 2),
                         [](const auto& pass) { return pass.param == 1 ? "One" : "Two"; });

}  // namespace
}  // namespace yadefrag::test
