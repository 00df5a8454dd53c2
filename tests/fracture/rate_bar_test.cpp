// Bars of concrete that are pulled at a constant strain rate, on irregular meshes: the strength is
// that of slow tests times the factor of the rate, and the energy of cracks is Gc·f^p.
//
// All nodes begin with the velocity of a homogeneous strain rate, and both ends keep it: no wave
// disturbs the stress, which grows evenly up to the first crack.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "dynamics/element_state.hpp"
#include "fracture/laboratory.hpp"
#include "fracture/separation.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr ElasticMaterial kConcrete{30e9, .2, 2400, true};
constexpr double kStrength = 3e6, kEnergy = 100;     // Pa, J/m²
constexpr double kLength = .06, kHeight = .03;       // m
constexpr double kSize = .005;                       // m
constexpr double kFailureStrain = kStrength / 30e9;  // of a slow test

struct Bar {
  double rate;   ///< 1/s
  double start;  ///< stress at the begin, over the strength of a slow test
  RateEffect effect{};
  double angle = 0;  ///< rad, of its axis
  double power = 1;  ///< rateEnergyPower
  double part = .5;  ///< step over the critical one
  double strength = kStrength, energy = kEnergy;
  std::uint64_t seed = 1;

  void addTo(World& world) const {
    const Polygon outline{{{0, 0}, {kLength, 0}, {kLength, kHeight}, {0, kHeight}}, {}};
    TriangleMesh mesh = triangulate(outline, {kSize}, {NodeLayout::kScattered, seed});
    BodySpec spec;
    spec.material = kConcrete;
    spec.brittle.tensileStrength = strength;
    spec.brittle.fractureEnergy = energy;
    spec.brittle.rate = effect;
    spec.brittle.rateEnergyPower = power;
    hold(spec, mesh, kHeldXY, [](Vec2 x) { return x.x < 1e-9 || x.x > kLength - 1e-9; });
    for (Vec2& x : mesh.nodes) {
      const Vec2 stretch = turnedBy({x.x, -kConcrete.poisson * x.y}, angle);
      spec.displacement.push_back(start * kFailureStrain * stretch);
      spec.velocity.push_back(rate * stretch);
      x = turnedBy(x, angle);
    }
    world.addBody(mesh, spec);
  }
};

/// (Pa) Along the axis, mean of the body.
double meanStress(const World& world, double angle) {
  const Vec2 axis = turnedBy({1, 0}, angle);
  const auto all = stresses(world.model);
  double sum = 0, whole = 0;
  for (std::size_t e = 0; e < all.size(); ++e) {
    sum += world.model.triangles.area[e] * tractionOn(all[e], axis).normal;
    whole += world.model.triangles.area[e];
  }
  return sum / whole;
}

/// (Pa) Mean stress at the first crack: between those before and after that step.
double peakOf(const Bar& bar) {
  World world;
  bar.addTo(world);
  const double dt = bar.part * world.criticalTimeStep();
  double now = meanStress(world, bar.angle);
  for (int n = 0; n < 200000; ++n) {
    const double last = now;
    world.step(dt);
    now = meanStress(world, bar.angle);
    if (world.fracture.numCracks() > 0) return (last + now) / 2;
  }
  ADD_FAILURE() << "it did not crack";
  return 0;
}

/// In so many steps from the strength of a slow test to that of the rate, if such steps are stable.
Bar concrete(double rate, double steps = 200, double angle = 0) {
  const RateEffect effect = rateEffectNamed("ceb-fip-2010");
  constexpr double kCritical = 7e-7;  // s, about
  const double lasts = (effect.factor(rate) - 1) * kFailureStrain / rate;
  return {.rate = rate,
          .start = .98,
          .effect = effect,
          .angle = angle,
          .part = std::min(.8, lasts / steps / kCritical)};
}

/// Over the peak of the same bar without a rate effect, and over the factor.
double overFactor(const Bar& bar) {
  Bar slow = bar;
  slow.effect = {}, slow.rate = 1, slow.part = .1;
  return peakOf(bar) / peakOf(slow) / bar.effect.factor(bar.rate);
}

// Of 200 steps each adds up to 1 %, of which the half remains. The edge with the best direction
// determines both peaks.
TEST(RateBar, TheStrengthIsThatOfTheStrainRate) {
  for (const double rate : {1e-2, 1e-1, 1., 10., 30., 100., 1000.})
    figure("over_factor_at_" + std::to_string(rate), overFactor(concrete(rate)), 1, .006);
}

TEST(RateBar, InAnyDirectionWithAnyStepOnAnyMesh) {
  for (const double angle : {17 * kDegree, 45 * kDegree, 80 * kDegree})
    figure("turned_by_" + std::to_string(angle), overFactor(concrete(50, 200, angle)), 1, .006);
  for (const double steps : {10, 20, 100, 400})
    figure("steps_" + std::to_string(steps), overFactor(concrete(50, steps)), 1, .003 + .5 / steps);
  for (const std::uint64_t seed : {2, 3}) {
    Bar bar = concrete(50);
    bar.seed = seed;
    figure("mesh_" + std::to_string(seed), overFactor(bar), 1, .006);
  }
}

/// A bar at 100 /s that breaks.
Bar breaking(double power = 1) {
  Bar bar = concrete(100);
  bar.power = power, bar.part = .1;
  return bar;
}

/// After 700 steps, in which the bar cracks.
void breakApart(World& world, const Bar& bar) {
  bar.addTo(world);
  const double dt = .1 * world.criticalTimeStep();
  for (int n = 0; n < 700; ++n) world.step(dt);
  EXPECT_GT(world.fracture.numCracks(), 20U);
}

// Each crack has σc·f and Gc·f^p, and edges without a crack have σc and Gc.
TEST(RateBar, CracksHaveStrengthAndEnergyOfTheirRate) {
  for (const double power : {0., .5, 2.}) {
    World world;
    breakApart(world, breaking(power));
    const CrackEdges& edges = world.fracture.edges;
    double least = INFINITY, most = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double factor = edges.strength[i] / kStrength;
      EXPECT_NEAR(edges.fractureEnergy[i], kEnergy * std::pow(factor, power), 1e-9 * kEnergy);
      if (edges.cracked[i] == 0)
        EXPECT_EQ(factor, 1);
      else
        least = std::min(least, factor), most = std::max(most, factor);
    }
    EXPECT_GE(least, 1);
    EXPECT_GT(most, 2.5);
    EXPECT_LE(most, rateEffectNamed("ceb-fip-2010").largest());
    record("least_factor", least), record("largest_factor", most);
  }
}

// A factor that is the same at any rate is a material with this strength and this energy: the same
// cracks, and the same energies.
TEST(RateBar, AConstantFactorIsAnotherMaterial) {
  constexpr double kFactor = 1.5, kPower = 2;
  Bar raised = breaking(kPower), plain = breaking();
  raised.effect = RateEffect({{1, kFactor}, {2, kFactor}});
  plain.effect = {};
  plain.strength = kFactor * kStrength, plain.energy = kFactor * kFactor * kEnergy;
  World worlds[2];
  breakApart(worlds[0], raised);
  breakApart(worlds[1], plain);
  EXPECT_EQ(worlds[0].fracture.numCracks(), worlds[1].fracture.numCracks());
  const double unit = kEnergy * kHeight;
  EXPECT_GT(worlds[1].ledger.fracture, .1 * unit);
  EXPECT_NEAR(worlds[0].ledger.fracture, worlds[1].ledger.fracture, 1e-6 * unit);
  EXPECT_NEAR(totalEnergy(worlds[0]), totalEnergy(worlds[1]), 1e-6 * unit);
}

}  // namespace
}  // namespace yadefrag::test
