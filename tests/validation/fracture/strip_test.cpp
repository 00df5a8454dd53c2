// A strip with a crack along half of its middle, pulled apart slowly: how much energy the loading
// has to offer before the crack runs.  ▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔  clamped, moves up        far behind
// the tip nothing is stored, far ───────────┤ · · · · ·   slit | may crack     H  ahead ½(λ+2μ)ε²
// per volume: a crack that runs ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁  clamped, moves down      on by dx gets G dx
// = ½(λ+2μ)ε²H dx from outside; sheared in place of pulled: ½μγ²H dx Kalthoff and Winkler 1987: a
// plate with two notches is hit between them; at low speed cracks leave the notches at about 70° to
// them, towards the void side. The upper half, 100 × 100 mm, its lower side held in y, driven at
// 16.5 m/s between there and the notch (50 mm long, 25 mm up).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/checks.hpp"
#include "fracture/laboratory.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr ElasticMaterial kGlass{32e9, .2, 2450, false};
constexpr double kEnergy = 3, kZone = .01, kHeight = 4 * kZone;  // J/m², m, m
constexpr int kLengthInHeights = 3;
constexpr double kTip = 1.25 * kHeight;  // m

/// A slit along the middle from the left end to the tip: its nodes double, the upper ones a little
/// higher, so that no contact is involved.
TriangleMesh slitStrip(int rows) {
  TriangleMesh mesh =
      structuredRectangle({0, -kHeight / 2}, {kLengthInHeights * kHeight, kHeight / 2},
                          kLengthInHeights * rows, rows, QuadPattern::kCrossed);
  const double size = kHeight / rows;
  const auto isMiddle = [&](std::uint32_t n) { return std::abs(mesh.nodes[n].y) < size / 8; };
  std::vector<std::uint32_t> lower;
  for (std::uint32_t n = 0; n < mesh.nodes.size(); ++n)
    if (isMiddle(n) && mesh.nodes[n].x < kTip + size / 8) lower.push_back(n);
  std::sort(lower.begin(), lower.end(),
            [&](auto a, auto b) { return mesh.nodes[a].x < mesh.nodes[b].x; });
  std::vector<std::uint32_t> upper(mesh.nodes.size());
  std::vector<std::uint32_t> faces;  // of the slit, towards the tip and back
  for (std::uint32_t n = 0; n < upper.size(); ++n) upper[n] = n;
  const std::uint32_t tip = lower.back();
  for (const std::uint32_t n : lower) {
    if (n != tip) {
      upper[n] = static_cast<std::uint32_t>(mesh.nodes.size());
      mesh.nodes.push_back(mesh.nodes[n] + Vec2{0, 1e-3 * size});
    }
    faces.push_back(upper[n]);
  }
  faces.insert(faces.end(), lower.rbegin() + 1, lower.rend());
  for (auto& triangle : mesh.triangles) {
    double height = 0;
    for (const std::uint32_t n : triangle) height += mesh.nodes[n].y;
    if (height < 0) continue;
    for (std::uint32_t& n : triangle) n = upper[n];
  }
  auto& loop = mesh.loops[0];
  const auto end = loop.erase(std::find(loop.begin(), loop.end(), lower.front()));
  loop.insert(end, faces.begin(), faces.end());
  mesh.loopVertices = mesh.loops;
  return mesh;
}

/// Moves the nodes inside at random, by at most `share` of an element each way; those along the
/// middle only along it, and not the slit's two faces, which stay opposite each other.
void jitterInside(TriangleMesh& mesh, double size, double share) {
  jitter(mesh, share * Vec2{size, size}, std::mt19937(1), [=](Vec2 x) {
    const bool inside = x.x > size / 8 && x.x < kLengthInHeights * kHeight - size / 8 &&
                        std::abs(x.y) < .499 * kHeight;
    const bool middle = std::abs(x.y) < size / 8;
    if (!inside || (middle && x.x < kTip + size / 8)) return Vec2{};
    return Vec2{1, middle ? 0. : 1.};
  });
}

struct Outcome {
  double release = 0;  // of Gc: G at the first break
  double ledger = 0;   // change of the total, of the work put in
};

struct Pull {
  int rows;
  double share = 0;    // of an element, jitter
  bool shear = false;  // along the crack
  double beta = 1, kappa = 1;
};

Outcome pullUntilBreak(const Pull& pull) {
  const int rows = pull.rows;
  TriangleMesh mesh = slitStrip(rows);
  const double size = kHeight / rows;
  jitterInside(mesh, size, pull.share);
  BodySpec spec = brittle(kGlass, std::sqrt(kGlass.young * kEnergy / kZone), kEnergy);
  spec.brittle.shearFactor = pull.beta;
  spec.brittle.shearEnergyFactor = pull.kappa;
  World world;
  world.addBody(mesh, spec);
  crackOnly(world, [=](Vec2 x) { return std::abs(x.y) < size / 8; });
  std::vector<NodeId> grips[2];
  for (std::uint32_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(mesh.nodes[n].y) > .499 * kHeight) grips[mesh.nodes[n].y > 0].emplace_back(n);

  const double crossing = kHeight / std::sqrt(kGlass.waveModulus() / kGlass.density);
  world.dynamicsSettings.damping = .5 / crossing;
  const double dt = .8 * world.criticalTimeStep();
  const double modulus =
      pull.shear ? kGlass.young / (2 * (1 + kGlass.poisson)) : kGlass.waveModulus();
  const double energy = pull.shear ? pull.kappa * kEnergy : kEnergy;
  const double critical = std::sqrt(2 * energy / (modulus * kHeight));
  const double most = pull.shear ? 2 : 1.15;  // of what is needed
  const double duration = 200 * crossing;
  Outcome outcome;
  double strain = 0;
  const auto broken = [&] {
    return world.fracture.numCracks() - world.fracture.cohesion.edge.size();
  };
  while (broken() == 0 && world.time < duration) {
    const double rate = most * critical * std::numbers::pi / (2 * duration) *
                        std::sin(std::numbers::pi * (world.time + dt / 2) / duration);
    for (const int top : {0, 1}) {
      const double speed = (top - .5) * rate * kHeight;
      world.prescribe(grips[top], kHeldXY, pull.shear ? Vec2{speed, 0} : Vec2{0, speed});
    }
    world.step(dt);
    strain += rate * dt;
  }
  EXPECT_GT(broken(), 0U);
  outcome.release = modulus * strain * strain * kHeight / (2 * energy);
  outcome.ledger = std::abs(totalEnergy(world)) / world.ledger.external;
  return outcome;
}

// Measured: 1.022, 1.021, 1.020 with a cohesive zone E·Gc/σc² of 6, 7.5 and 9 elements. Two things
// make it more than 1, each by a few percent. The crack breaks while the loading goes on, by 1.2 %
// of G in the time a wave takes across the strip; with half the speed it is 0.005 to 0.012 less.
// And edges before the tip crack when the stress averaged around their nodes reaches the strength,
// which it does the later the coarser the elements are. The total is kept to 10⁻⁸ of the work.
TEST(Strip, CrackRunsAtTheFractureEnergy) {
  double least = INFINITY, most = 0;
  for (const int rows : {24, 30, 36}) {
    const Outcome outcome = pullUntilBreak({rows});
    RecordProperty("release_" + std::to_string(rows), std::to_string(outcome.release));
    EXPECT_NEAR(outcome.release, 1, .05) << rows;
    EXPECT_LT(outcome.ledger, .002) << rows;
    least = std::min(least, outcome.release), most = std::max(most, outcome.release);
  }
  EXPECT_LT(most / least, 1.05);
}

// A fifth of an element each way. Measured: 1.020, as with the regular mesh.
TEST(Strip, TheMeshNeedNotBeRegular) {
  const Outcome outcome = pullUntilBreak({24, .2});
  RecordProperty("release", std::to_string(outcome.release));
  EXPECT_NEAR(outcome.release, 1, .05);
  EXPECT_LT(outcome.ledger, .002);
}

// Measured: GII at the first break over κGc is 1.05, 1.07 with 6 and 16 elements in the zone
// E·κGc/(βσc)² of a crack that slides, 1.03 with β = 2, κ = 4. With the pull alone at the tip 1.49
// and 1.08 (fracture/tip_pull.cpp).
TEST(Strip, SlidingCrackHasItsOwnZone) {
  const Outcome six = pullUntilBreak({.rows = 24, .shear = true});
  const Outcome same = pullUntilBreak({.rows = 24, .shear = true, .beta = 2, .kappa = 4});
  const Outcome sixteen = pullUntilBreak({.rows = 16, .shear = true, .kappa = 4});
  const Outcome four = pullUntilBreak({.rows = 16, .shear = true});
  RecordProperty("release_4", std::to_string(four.release));
  RecordProperty("release_6", std::to_string(six.release));
  RecordProperty("release_16", std::to_string(sixteen.release));
  EXPECT_NEAR(four.release, 1.05, .1);
  EXPECT_NEAR(six.release, 1.05, .05);
  EXPECT_NEAR(same.release, six.release, .04);
  EXPECT_NEAR(sixteen.release, 1.05, .05);
}

constexpr double kEdge = .1;                // m
constexpr Vec2 kNotchTip{.05, .025};        // m
constexpr double kRayleigh = 2800;          // m/s
constexpr double kSpeed = 16.5;             // m/s
constexpr double kStrength = 1.07e9;        // Pa
constexpr double kFractureEnergy = 22.2e3;  // J/m²

void addPlate(World& world, const Trial& plate) {
  const TriangleMesh mesh =
      plate.mesh(plateWithNotch({0, 0}, {kEdge, kEdge}, kNotchTip, plate.size));
  BodySpec spec = brittle({190e9, .3, 8000, false}, kStrength, kFractureEnergy);
  spec.held.assign(mesh.nodes.size(), kFree);
  spec.velocity.assign(mesh.nodes.size(), {});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].y < 1e-9) spec.held[i] |= kHeldY;
    if (mesh.nodes[i].x > 1e-9 || mesh.nodes[i].y > kNotchTip.y) continue;
    spec.held[i] |= kHeldX;
    spec.velocity[i] = {kSpeed, 0};
  }
  world.addBody(mesh, spec);
}

struct Crack {
  double fit = 0;  // °, of the line through the notch's tip that fits all open edges above it best
  double chord = 0;    // °, from the notch's tip to the highest point
  double highest = 0;  // m
};

Crack crackOf(const World& world) {
  Crack crack;
  double along = 0, up = 0;
  Vec2 top = kNotchTip;
  for (const CrackLine& edge : cracksOf(world, true)) {
    const Vec2 from = edge.middle() - kNotchTip;
    if (from.y < 0 || (from.x < .01 && from.y < .005)) continue;
    along += from.x * from.y;
    up += from.y * from.y;
    for (const Vec2 end : {edge.first, edge.last})
      if (end.y > top.y) top = end;
  }
  constexpr double kDegrees = 180 / std::numbers::pi;
  crack.fit = std::atan2(up, along) * kDegrees;
  crack.chord = std::atan2(top.y - kNotchTip.y, top.x - kNotchTip.x) * kDegrees;
  crack.highest = top.y;
  return crack;
}

/// The angle (°) at which the crack leaves the plate.
double angleOf(const Trial& plate) {
  World world;
  addPlate(world, plate);
  const double start = world.kineticEnergy();
  const double dt = .8 * world.criticalTimeStep();
  constexpr double kWindow = 10e-6;  // s
  double next = 0, former = kNotchTip.y, fastest = 0;
  while (world.time < 90e-6) {
    world.step(dt);
    if (world.time < next) continue;
    next += kWindow;
    const Crack crack = crackOf(world);
    const double rise = crack.highest - former;
    fastest = std::max(fastest, rise / std::sin(crack.chord * std::numbers::pi / 180) / kWindow);
    former = crack.highest;
  }
  const Crack crack = crackOf(world);
  const std::string mesh = std::to_string(plate.seed);
  record("fitted_angle_" + mesh, crack.fit);
  record("speed_over_rayleigh_" + mesh, fastest / kRayleigh);
  EXPECT_LT(fastest, .75 * kRayleigh);
  EXPECT_GT(crack.highest, .095) << "it runs through";
  // Measured 6·10⁻⁶ to 1.2·10⁻⁵: strains of a percent behind the shock, of second order in Δt.
  EXPECT_NEAR(totalEnergy(world), start, 1e-4 * world.ledger.external);
  return crack.chord;
}

/// Measured in the experiment: 70°. Angles are from the notch's tip to the point where the crack
/// leaves the plate at the top, on meshes with four elements in a cohesive zone of 3.7 mm. Twelve
/// meshes: 67.5° to 73.6°, mean 70.4°, standard deviation 2.1°: each mesh must be within three of
/// these, the mean of five within 2.1°, 2.2 times its own; an element at the top is 0.5°. The line
/// that fits all edges has 63.3° to 68.6°, since a crack starts at a smaller angle and turns
/// upwards. Speeds, in 10 µs: .63 to .72 of that of Rayleigh's waves; they must be below .75. With
/// three elements or fewer (1.25, 1.5 mm) angles are 65° to 72.4°.
TEST(KalthoffWinkler, CracksAtTheKnownAngle) {
  constexpr std::uint64_t kMeshes = 5;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kMeshes; ++seed) {
    const double angle = angleOf({.9e-3, seed});
    figure("angle_" + std::to_string(seed), angle, 70, 6.3);
    sum += angle;
  }
  figure("mean_angle", sum / kMeshes, 70, 2.1);
}

}  // namespace
}  // namespace yadefrag::test
