// Kalthoff and Winkler 1987: a plate with two notches is hit between them; at low speed cracks
// leave the notches at about 70° to them, towards the void side. The upper half, 100 × 100 mm, its
// lower side held in y, driven at 16.5 m/s between there and the notch (50 mm long, 25 mm up).
#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <numbers>
#include <string>

#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kEdge = .1;                // m
constexpr Vec2 kTip{.05, .025};             // m
constexpr double kRayleigh = 2800;          // m/s
constexpr double kSpeed = 16.5;             // m/s
constexpr double kStrength = 1.07e9;        // Pa
constexpr double kFractureEnergy = 22.2e3;  // J/m²

/// Which mesh.
struct Plate {
  double size;  // m
  std::uint64_t seed = 1;
};

void addPlate(World& world, const Plate& plate) {
  const double size = plate.size;
  const double slit = size / 20;
  const TriangleMesh mesh = triangulate({{{0, 0},
                                          {kEdge, 0},
                                          {kEdge, kEdge},
                                          {0, kEdge},
                                          {0, kTip.y + slit},
                                          kTip,
                                          {0, kTip.y - slit}},
                                         {}},
                                        size, {NodeLayout::kScattered, plate.seed});
  BodySpec spec;
  spec.material = {190e9, .3, 8000, false};
  spec.brittle.tensileStrength = kStrength;
  spec.brittle.fractureEnergy = kFractureEnergy;
  spec.held.assign(mesh.nodes.size(), kFree);
  spec.velocity.assign(mesh.nodes.size(), {});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (mesh.nodes[i].y < 1e-9) spec.held[i] |= kHeldY;
    if (mesh.nodes[i].x > 1e-9 || mesh.nodes[i].y > kTip.y) continue;
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
  Vec2 top = kTip;
  for (const CrackLine& edge : cracksOf(world, true)) {
    const Vec2 from = edge.middle() - kTip;
    if (from.y < 0 || (from.x < .01 && from.y < .005)) continue;
    along += from.x * from.y;
    up += from.y * from.y;
    for (const Vec2 end : {edge.first, edge.last})
      if (end.y > top.y) top = end;
  }
  constexpr double kDegrees = 180 / std::numbers::pi;
  crack.fit = std::atan2(up, along) * kDegrees;
  crack.chord = std::atan2(top.y - kTip.y, top.x - kTip.x) * kDegrees;
  crack.highest = top.y;
  return crack;
}

/// The angle (°) at which the crack leaves the plate.
double angleOf(const Plate& plate) {
  World world;
  addPlate(world, plate);
  const double start = world.kineticEnergy();
  const double dt = .8 * world.criticalTimeStep();
  constexpr double kWindow = 10e-6;  // s
  double next = 0, former = kTip.y, fastest = 0;
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
  EXPECT_NEAR(world.ledger.total(world.kineticEnergy(), world.strainEnergy()), start,
              1e-4 * world.ledger.external);
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
