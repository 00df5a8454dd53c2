// Kalthoff and Winkler 1987: a plate with two notches is hit between them; at low speed cracks
// leave the notches at about 70° to them, towards the void side. The upper half, 100 × 100 mm, its
// lower side held in y, driven at 16.5 m/s between there and the notch (50 mm long, 25 mm up).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fracture/open_edges.hpp"
#include "mesh/triangulate.hpp"

namespace yadefrag::test {
namespace {

constexpr double kEdge = .1;                // m
constexpr Vec2 kTip{.05, .025};             // m
constexpr double kSpeed = 16.5;             // m/s
constexpr double kStrength = 1.07e9;        // Pa
constexpr double kFractureEnergy = 22.2e3;  // J/m²

void addPlate(World& world, double size) {
  const double slit = size / 20;
  const TriangleMesh mesh = triangulate({{{0, 0},
                                          {kEdge, 0},
                                          {kEdge, kEdge},
                                          {0, kEdge},
                                          {0, kTip.y + slit},
                                          kTip,
                                          {0, kTip.y - slit}},
                                         {}},
                                        size, {NodeLayout::kScattered, 1});
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

class KalthoffWinkler : public testing::TestWithParam<double> {};

/// 60° to 75° is what codes report. Measured by the line through the notch's tip that fits all open
/// edges above it best: 66.7°, 65.9°, 65.4°, 64.3° with 1.5, 1.25, 1 and 0.8 mm; from the tip to
/// where the crack leaves at the top 69° to 71°.
TEST_P(KalthoffWinkler, CracksAtTheKnownAngle) {
  World world;
  addPlate(world, GetParam());
  const double start = world.kineticEnergy();
  const double dt = .8 * world.criticalTimeStep();
  while (world.time < 90e-6) world.step(dt);
  double along = 0, up = 0, highest = 0;
  for (const OpenEdge& edge : openEdges(world)) {
    const Vec2 from = edge.middle() - kTip;
    if (from.y < 0 || (from.x < .01 && from.y < .005)) continue;
    along += from.x * from.y;
    up += from.y * from.y;
    highest = std::max(highest, edge.middle().y);
  }
  const double angle = std::atan2(up, along) * 180 / std::numbers::pi;
  EXPECT_GT(angle, 60);
  EXPECT_LT(angle, 75);
  EXPECT_GT(highest, .095) << "it runs through";
  // Measured 6·10⁻⁶ to 1.2·10⁻⁵: strains of a percent behind the shock, of second order in Δt.
  EXPECT_NEAR(world.ledger.total(world.kineticEnergy(), world.strainEnergy()), start,
              1e-4 * world.ledger.external);
}

INSTANTIATE_TEST_SUITE_P(Sizes, KalthoffWinkler, testing::Values(1.5e-3, 1.25e-3, 1e-3));

}  // namespace
}  // namespace yadefrag::test
