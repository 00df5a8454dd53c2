// A ring of aluminium 6061-T6 that expands breaks into fragments. Mott (1947, Proc. R. Soc. A 189,
// 300): sections fail at strains that scatter; from each a release wave, behind which nothing flows
// or fails any more, runs by x = √(2Y Δp/ρ) r/v while the strain elsewhere grows by Δp. With the
// chance h(p) dp per length (m) that a section fails, 1/s fragments come to a length,
//   1/s = ∫ h exp(−∫ 2x h dp') dp.
// For Weibull's h = m/(L₀p₀) (p/p₀)ᵐ⁻¹ the integrals have a closed form, with
// s ∝ (√(2Y/ρ) r/v)^(2m/(2m+1)) as in Grady 2006 (Fragmentation of Rings and Shells); for
// h ∝ exp(γp), s = √π x₀ with Mott's length x₀ = √(2Y/(ργ)) r/v, which differs by 3 %.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fracture/edge_strength.hpp"
#include "fracture/overlaps.hpp"
#include "plasticity/yielding_bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kRadius = 64e-3, kWidth = 1e-3;  // m
constexpr double kModulus = 6, kStrain = .2;      // of the scatter: m, p₀ for a length of
constexpr double kSection = kWidth;               // m, L₀
constexpr double kAround = 2 * std::numbers::pi * kRadius;

BodySpec aluminium(double energy) {
  BodySpec spec;
  spec.material = {68.9e9, .33, 2700, false};
  spec.element = ElementKind::kSmoothed;
  PlasticMaterial& m = spec.plastic;
  m.yieldStress = 324e6, m.hardening = 114e6, m.hardeningExponent = .42, m.rateFactor = .002;
  m.thermalExponent = 1.34, m.meltTemperature = 925, m.heatCapacity = 896;
  m.failure.strain = kStrain, m.failure.energy = energy;
  return spec;
}

/// Fragments of the ring by Mott's theory, with the stress and the speed at the strain at which
/// most sections fail; the work of the flow has slowed it down.
double expectedFragments(const BodySpec& spec, double speed) {
  constexpr double m = kModulus;
  const double density = spec.material.density;
  const double scaled = m / (kSection * std::pow(kStrain, m));  // h/pᵐ⁻¹
  const double beta = std::exp(std::lgamma(m) + std::lgamma(1.5) - std::lgamma(m + 1.5));
  double strain = kStrain, fragments = 0;
  for (int i = 0; i < 50; ++i) {
    double work = 0;  // J/m³
    for (int k = 0; k < 100; ++k)
      work += staticStress(spec.plastic, (k + .5) / 100 * strain).stress * strain / 100;
    const double now = std::sqrt(speed * speed - 2 * work / density);
    const double yield = staticStress(spec.plastic, strain).stress;
    const double wave = std::sqrt(2 * yield / density) * kRadius / now;  // x/√Δp
    const double shadow = 2 * wave * scaled * beta;                      // ∫ 2x h / p^(m+½)
    strain = std::pow(shadow, -1 / (m + .5));
    fragments = kAround * scaled / (m + .5) * std::tgamma(m / (m + .5)) * std::pow(strain, m);
  }
  return fragments;
}

/// Factors of the failure strain, one for each section of the ring.
std::vector<double> scattered(const TriangleMesh& mesh, std::uint64_t seed) {
  const auto sections = static_cast<std::size_t>(std::lround(kAround / kSection));
  BrittleMaterial weibull;
  weibull.weibullModulus = kModulus, weibull.seed = seed;
  std::vector<double> factors;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 x = mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c];
    const double turns = std::atan2(x.y, x.x) / (2 * std::numbers::pi) + .5;
    const auto section = static_cast<std::uint64_t>(turns * static_cast<double>(sections));
    factors.push_back(scatterFactor(weibull, std::min<std::uint64_t>(section, sections - 1), 1));
  }
  return factors;
}

/// With `rows` triangles across, its points turned by `turn` (rad).
TriangleMesh ringMesh(int rows, std::uint64_t seed, double turn = 0) {
  const double size = kWidth / rows;
  const int count = static_cast<int>(std::lround(kAround / size));
  const Polygon polygon{circle({}, kRadius + kWidth / 2, count, turn),
                        {circle({}, kRadius - kWidth / 2, count, turn)}};
  return triangulate(polygon, size, {NodeLayout::kScattered, seed});
}

struct Expanded {
  double fragments = 0, expected = 0;
};

Expanded expand(const TriangleMesh& mesh, double speed, std::uint64_t seed, double energy = 3e3,
                double strain = .28) {
  World world;
  BodySpec spec = aluminium(energy);
  spec.places.strength = scattered(mesh, seed);
  for (const Vec2 x : mesh.nodes) spec.velocity.push_back(speed / norm(x) * x);
  world.addBody(mesh, spec);
  const double start = totalEnergy(world), end = strain * kRadius / speed;
  double dt = .8 * world.criticalTimeStep();
  while (world.time < end) {
    if (world.hasFlowed()) dt = std::min(dt, .8 * world.criticalTimeStep());
    world.step(dt);
  }
  // The leapfrog's invariant neglects the square of a step's strain.
  EXPECT_NEAR((totalEnergy(world) + world.pendingPlastic()) / start, 1, 1e-6);
  const double thrown = mass(world, ComponentId(0)) * speed;
  EXPECT_LT(norm(momentum(world, ComponentId(0))), 1e-6 * thrown);  // that of the mesh at rest
  Expanded result{0, expectedFragments(spec, speed)};
  for (const double area : wholePieces(world))
    if (area > .5 * kWidth * kWidth) ++result.fragments;  // others are chips of a crack
  return result;
}

/// Found over expected fragments of three speeds, each with a scatter and a mesh of its own. One
/// count is that of one draw: six draws at 1000 m/s have 48 to 56 instead of 45. On the mean there
/// are 1.06 to 1.22 times as many as expected.
double meanOverMott(int rows, std::uint64_t seed, double turn = 0) {
  double mean = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const double speed = 400 + 300. * static_cast<double>(i);
    const Expanded ring = expand(ringMesh(rows, seed + i, turn), speed, seed + i);
    record("at_" + std::to_string(static_cast<int>(speed)), ring.fragments);
    EXPECT_NEAR(ring.fragments / ring.expected, 1.15, .35) << speed;
    mean += ring.fragments / ring.expected / 3;
  }
  return mean;
}

TEST(ExpandingRing, FragmentsAsByMott) { figure("fragments_over_mott", meanOverMott(3, 1), 1, .3); }

// Half a minute each.
TEST(ExpandingRing, FinerTurnedOtherSeeds) {
  figure("finer", meanOverMott(5, 1), 1.1, .2);
  figure("turned", meanOverMott(3, 1, .3), 1.1, .2);
  figure("seed_4", meanOverMott(3, 4), 1.1, .2);
  figure("seed_7", meanOverMott(3, 7), 1.1, .2);
}

/// A large fracture energy makes fewer fragments than Mott's, down to those of the length of Grady
/// and Kipp, (24 G/(ρ ε̇²))^⅓, for which the kinetic energy is just enough.
TEST(ExpandingRing, AFractureEnergyLimitsTheFragments) {
  constexpr double kSpeed = 1000, kEnergy = 1e5;
  const double rate = kSpeed / kRadius;
  const double energetic = kAround / std::cbrt(24 * kEnergy / (2700 * rate * rate));
  const Expanded ring = expand(ringMesh(3, 1), kSpeed, 1, kEnergy, .75);
  EXPECT_LT(ring.fragments, .8 * ring.expected);
  figure("fragments_over_grady_kipp", ring.fragments / energetic, 1.2, .2);
}

}  // namespace
}  // namespace yadefrag::test
