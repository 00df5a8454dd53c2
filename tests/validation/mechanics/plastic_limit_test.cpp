// Closed solutions of ideal plasticity at rest. A ring of aluminium 6061-T6 that expands breaks
// into fragments. Mott (1947, Proc. R. Soc. A 189, 300): sections fail at strains that scatter;
// from each a release wave, behind which nothing flows or fails any more, runs by x = √(2Y Δp/ρ)
// r/v while the strain elsewhere grows by Δp. With the chance h(p) dp per length (m) that a section
// fails, 1/s fragments come to a length, 1/s = ∫ h exp(−∫ 2x h dp') dp. For Weibull's h = m/(L₀p₀)
// (p/p₀)ᵐ⁻¹ the integrals have a closed form, with s ∝ (√(2Y/ρ) r/v)^(2m/(2m+1)) as in Grady 2006
// (Fragmentation of Rings and Shells); for h ∝ exp(γp), s = √π x₀ with Mott's length x₀ =
// √(2Y/(ργ)) r/v, which differs by 3 %.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/checks.hpp"
#include "fracture/edge_strength.hpp"
#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

// --- A rigid flat punch on an ideally plastic half-space (Prandtl 1920; Hill 1950, ch. IX): the
// mean pressure becomes (2 + π) k, for a smooth and for a rough punch.

constexpr double kHalf = 10e-3;  // m, half of the punch

/// Mean pressure over (2 + π) k of the right half; the plane x = 0 is one of symmetry.
double punched(double size, bool rough, double degrees, ElementKind kind = ElementKind::kSmoothed,
               NodeLayout layout = NodeLayout::kRows) {
  const double wide = 5 * kHalf, deep = 3 * kHalf;
  const Polygon half{{{0, -deep}, {wide, -deep}, {wide, 0}, {kHalf, 0}, {0, 0}}, {}};
  const TriangleMesh mesh = turnedMesh(half, size, degrees, {layout, 1});
  BodySpec spec = idealSteel(600e6, kind);
  hold(spec, mesh, kHeldXY, [&](Vec2 x) { return x.y < -deep + 1e-9; });
  hold(spec, mesh, kHeldX, [&](Vec2 x) { return x.x < 1e-9 || x.x > wide - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const double speed = 1;  // m/s
  const auto under =
      nodesWhere(world.model.nodes, [](Vec2 x) { return x.y > -1e-9 && x.x < kHalf * 1.0001; });
  std::vector<NodeId> free, centre;
  for (const NodeId n : under)
    (world.model.nodes.reference[n.value].x < 1e-9 ? centre : free).push_back(n);
  world.prescribe(centre, kHeldXY, {0, -speed});
  world.prescribe(free, rough ? kHeldXY : kHeldY, {0, -speed});
  world.dynamicsSettings.damping = 2e4;
  const double dt = .7 * world.criticalTimeStep();
  const int steps = static_cast<int>(.04 * kHalf / (speed * dt));
  return meanForce(world, under, dt, steps) /
         (kHalf * (2 + std::numbers::pi) * shearStrength(spec));
}

// The end of a punch has a singular stress; with five and ten sides below its half the mean
// pressure is 1.04 and 1.00 of the solution.
TEST(Punch, PrandtlsPressure) {
  for (const bool rough : {false, true})
    for (const double degrees : {0., 15., 30.})
      EXPECT_NEAR(punched(kHalf / 5, rough, degrees), 1, .05) << rough << ' ' << degrees;
  EXPECT_NEAR(punched(kHalf / 10, true, 0), 1, .05);
}

// Linear triangles lock: with five and ten sides 1.10 and 1.04, on irregular meshes 1.13 and 1.06.
TEST(Punch, LockingOfMeshesWithoutRows) {
  for (const double degrees : {0., 15., 30.}) {
    const auto irregular = [&](ElementKind kind) {
      return punched(kHalf / 10, true, degrees, kind, NodeLayout::kScattered);
    };
    EXPECT_NEAR(irregular(ElementKind::kSmoothed), 1, .02) << degrees;
    EXPECT_NEAR(irregular(ElementKind::kLinear), 1.06, .02) << degrees;
  }
  EXPECT_NEAR(punched(kHalf / 5, true, 0, ElementKind::kLinear), 1.105, .015);
}

// --- A rigid strip footing on a weightless frictional half-space (Prandtl; Terzaghi 1943): the
// mean pressure becomes Nc·c, Nc = (e^(π tan φ) tan²(π/4 + φ/2) − 1)/tan φ. Drucker and Prager's
// cone is matched to Mohr and Coulomb in plane strain for associated flow.

constexpr double kFooting = .5;  // m, half of the footing

/// Mesh of the right half, turned by `degrees` and back. It is fine at the end of the footing,
/// where the stress is singular.
TriangleMesh halfSpace(double wide, double deep, double finest, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  Polygon half{{{0, -deep}, {wide, -deep}, {wide, 0}, {kFooting, 0}, {0, 0}}, {}};
  Vec2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (Vec2& p : half.outline) {
    p = turnedBy(p, angle);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  constexpr double kCell = .05;
  const auto columns = static_cast<std::uint32_t>((high.x - low.x) / kCell) + 2;
  const auto rows = static_cast<std::uint32_t>((high.y - low.y) / kCell) + 2;
  const Vec2 end = turnedBy({kFooting, 0}, angle);
  std::vector<double> sizes;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const Vec2 at = low + Vec2{i * kCell, j * kCell};
      sizes.push_back(std::min(kFooting / 5, finest + .1 * norm(at - end)));
    }
  TriangleMesh mesh =
      triangulate(half, SizeField(low, kCell, columns, sizes), {NodeLayout::kRows, 1});
  mesh.nodes = turnedLoop(mesh.nodes, -angle);
  return mesh;
}

/// Mean pressure over Nc·c.
double footing(double finest, double degrees, ElementKind kind = ElementKind::kSmoothed) {
  constexpr double kFriction = .35;  // rad
  const double wide = 6 * kFooting, deep = 4 * kFooting;
  const TriangleMesh mesh = halfSpace(wide, deep, finest, degrees);
  BodySpec spec;
  spec.material = {4e9, .3, 2000, false};
  spec.element = kind;
  spec.plastic.cohesion = 1e5;
  spec.plastic.internalFriction = spec.plastic.dilation = std::tan(kFriction);
  hold(spec, mesh, kHeldXY, [&](Vec2 x) { return x.y < -deep + 1e-9; });
  hold(spec, mesh, kHeldX, [&](Vec2 x) { return x.x < 1e-9 || x.x > wide - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const auto under =
      nodesWhere(world.model.nodes, [](Vec2 x) { return x.y > -1e-9 && x.x < kFooting * 1.0001; });
  // The damping acts against the flow: with five times its force the pressure is 0.03 higher.
  constexpr double kSpeed = .02;  // m/s
  world.prescribe(under, kHeldXY, {0, -kSpeed});
  world.dynamicsSettings.damping = 40;
  const double dt = .7 * world.criticalTimeStep();
  const double t = std::tan(kFriction), k = std::tan(std::numbers::pi / 4 + kFriction / 2);
  const double factor = (std::exp(std::numbers::pi * t) * k * k - 1) / t;
  const int steps = static_cast<int>(.0026 * kFooting / (kSpeed * dt));
  return meanForce(world, under, dt, steps) / (kFooting * factor * spec.plastic.cohesion);
}

// The error is that of the mesh at the end of the footing: it becomes less as that is refined.
TEST(StripFooting, BearingCapacity) {
  for (const double degrees : {0., 15., 30.})
    EXPECT_NEAR(footing(.03 * kFooting, degrees), 1, .05) << degrees;
  const double coarse = footing(.1 * kFooting, 0);
  EXPECT_GT(coarse, 1.05);
  EXPECT_LT(coarse, 1.12);
}

// --- A thick-walled tube under internal pressure, plane strain, ideally plastic (Hill 1950, The
// Mathematical Theory of Plasticity, ch. V): with the plastic zone up to the radius c,
//   p = 2k ln(c/a) + k (1 − c²/b²), and at most 2k ln(b/a).

constexpr double kInner = 10e-3, kOuter = 20e-3;

/// The inner side moves outwards at a constant speed.
class Tube {
 public:
  Tube(double size, double degrees, ElementKind kind = ElementKind::kSmoothed) {
    const auto circleOf = [=](double radius) {
      return circle({}, radius,
                    static_cast<int>(std::lround(2 * std::numbers::pi * radius / size)));
    };
    mesh_ = turnedMesh({circleOf(kOuter), {circleOf(kInner)}}, size, degrees);
    spec = idealSteel(300e6, kind);
    world.addBody(mesh_, spec);
    inner_ = nodesWhere(world.model.nodes, [&](Vec2 x) { return norm(x) < kInner * 1.0001; });
    std::vector<Vec2> speeds;
    for (const NodeId n : inner_) {
      const Vec2 x = world.model.nodes.reference[n.value];
      speeds.push_back(kSpeed / norm(x) * x);
    }
    world.prescribeEach(inner_, kHeldXY, speeds);
    world.dynamicsSettings.damping = 5e4;
    dt = .8 * world.criticalTimeStep();
  }
  void widen(double by) {
    const int steps = static_cast<int>(by / (kSpeed * dt));
    for (int i = 0; i < steps; ++i) world.step(dt);
  }
  [[nodiscard]] double pressure() const {
    double push = 0;
    for (const NodeId n : inner_) {
      const Vec2 x = world.model.nodes.reference[n.value];
      push += dot(world.reactions[n.value], x) / norm(x);
    }
    return push / (2 * std::numbers::pi * kInner);
  }
  /// Radius of the circle with the area of all triangles that have flowed.
  [[nodiscard]] double plasticRadius() const {
    double area = std::numbers::pi * kInner * kInner;
    for (std::size_t e = 0; e < world.model.triangles.size(); ++e)
      if (world.model.triangles.plastic.strain[e] > 0) area += world.model.triangles.area[e];
    return std::sqrt(area / std::numbers::pi);
  }

  World world;
  BodySpec spec;
  double dt = 0;

 private:
  static constexpr double kSpeed = .25;  // m/s
  TriangleMesh mesh_;
  std::vector<NodeId> inner_;
};

TEST(ThickCylinder, PressureByTheRadiusOfThePlasticZone) {
  struct Case {
    double degrees, size, strain;
  };
  for (const auto& [degrees, size, strain] :
       {Case{0, 1e-3, .0028}, {15, 1e-3, .0028}, {30, 1e-3, .0028}, {0, .5e-3, .002}}) {
    Tube tube(size, degrees);
    tube.widen(strain * kInner);
    const double k = shearStrength(tube.spec), c = tube.plasticRadius();
    const double pressure = 2 * k * std::log(c / kInner) + k * (1 - c * c / (kOuter * kOuter));
    EXPECT_GT(c, 1.2 * kInner);
    EXPECT_NEAR(tube.pressure() / pressure, 1, .02) << degrees << ' ' << strain;
  }
}

double overLimit(double size, double degrees, ElementKind kind) {
  Tube tube(size, degrees, kind);
  tube.widen(.012 * kInner);
  return tube.pressure() / (2 * shearStrength(tube.spec) * std::log(kOuter / kInner));
}

TEST(ThickCylinder, LimitPressure) {
  for (const double degrees : {0., 15., 30.})
    EXPECT_NEAR(overLimit(2e-3, degrees, ElementKind::kSmoothed), 1, .02) << degrees;
  EXPECT_NEAR(overLimit(1e-3, 0, ElementKind::kSmoothed), 1, .01);
  // Linear triangles lock: five rows are 10 % too strong.
  EXPECT_GT(overLimit(2e-3, 0, ElementKind::kLinear), 1.08);
}

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
  return byTriangle<double>(mesh, [&](Vec2 x) {
    const double turns = std::atan2(x.y, x.x) / (2 * std::numbers::pi) + .5;
    const auto section = static_cast<std::uint64_t>(turns * static_cast<double>(sections));
    return scatterFactor(weibull, std::min<std::uint64_t>(section, sections - 1), 1);
  });
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
