// Frictional materials that crack where tension reaches their limit, also after they were crushed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fracture/overlaps.hpp"
#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kLength = 20e-3, kHeight = 4e-3;  // m
constexpr double kNet = .95 * kHeight;             // m, of the middle
constexpr double kPoisson = .2;
constexpr double kTension = 1.2e6, kEnergy = 6;    // Pa, J/m²
constexpr double kCohesion = 5e6, kFriction = .5;  // Pa, rad

/// A bar of concrete, 5 % thinner in its middle, whose right end is moved.
struct Bar {
  World world;
  std::vector<NodeId> left, right;
  double dt = 0;
  double most = 0, least = 0;  // Pa, mean stress of the middle

  explicit Bar(ElementKind kind, int rows = 4, double energy = kEnergy,
               double strain = FailureLaw::kNone) {
    BodySpec spec;
    spec.material = {30e9, kPoisson, 2400, false};
    spec.element = kind;
    PlasticMaterial& m = spec.plastic;
    m.cohesion = kCohesion, m.internalFriction = m.dilation = std::tan(kFriction);
    m.tensionLimit = kTension;
    m.failure.energy = energy, m.failure.strain = strain;
    if (energy > 0) m.failure.spallStress = kTension;
    TriangleMesh mesh = structuredRectangle({0, 0}, {kLength, kHeight}, 5 * rows, rows);
    for (Vec2& x : mesh.nodes) {
      const double toMiddle = 1 - std::abs(2 * x.x / kLength - 1);
      x.y = kHeight / 2 + (x.y - kHeight / 2) * (1 + toMiddle * (kNet / kHeight - 1));
    }
    hold(spec, mesh, kHeldX, [](Vec2 x) { return x.x < 1e-9 || x.x > kLength - 1e-9; });
    world.addBody(mesh, spec);
    left = nodesWhere(world.model.nodes, [](Vec2 x) { return x.x < 1e-9; });
    right = nodesWhere(world.model.nodes, [](Vec2 x) { return x.x > kLength - 1e-9; });
    world.dynamicsSettings.viscosity = {.06, 1.2};
    dt = .8 * world.criticalTimeStep();
  }
  void move(double speed, double duration) {
    const double begin = world.time;
    world.prescribeMotion(right, kHeldX, {.speedX = TimeTable({begin, begin + 40e-6}, {0, speed})});
    while (world.time < begin + duration) {
      world.step(dt);
      double force = 0;  // mean of both ends, between which waves run
      for (const NodeId n : right) force += world.reactions[n.value].x / 2;
      for (const NodeId n : left) force -= world.reactions[n.value].x / 2;
      most = std::max(most, force / kNet), least = std::min(least, force / kNet);
    }
  }
  [[nodiscard]] double energyError() const {
    return (totalEnergy(world) + world.pendingPlastic()) / world.ledger.external;
  }
};

/// Without flow the mean stress is (1 + ν)/3 of the bar's. The bar cracks across, and takes the
/// fracture energy of that section and of some edges beside it, which opened partly.
void pull(ElementKind kind, int rows) {
  Bar bar(kind, rows);
  bar.move(.04, 220e-6);
  const double strength = 3 * kTension / (1 + kPoisson);
  double strongest = 0;
  const CrackEdges& edges = bar.world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.cracked[i] != 0) strongest = std::max(strongest, edges.strength[i]);
  EXPECT_NEAR(strongest / strength, 1, .01);  // of a step: .2 %
  // The force still grows by 5 % in the 4 µs that a wave needs from the crack to the ends.
  EXPECT_NEAR(bar.most / strength, 1, .08);
  EXPECT_EQ(wholePieces(bar.world).size(), 2);
  const double wanted = kNet * kEnergy;
  EXPECT_GT(bar.world.ledger.fracture, .98 * wanted);
  EXPECT_LT(bar.world.ledger.fracture, 1.4 * wanted);
  EXPECT_LT(bar.world.ledger.plastic, .01 * wanted);
  EXPECT_LT(std::abs(bar.energyError()), 1e-5);
}

TEST(Crushing, ABarCracksAtTheTensionLimit) {
  for (const ElementKind kind : {ElementKind::kSmoothed, ElementKind::kLinear})
    for (const int rows : {4, 8}) pull(kind, rows);
}

/// c and φ are matched in plane strain: the crushing strength is that of Mohr and Coulomb. Then the
/// bar is pulled, and cracks.
void crush(ElementKind kind, int rows) {
  Bar bar(kind, rows);
  bar.move(-.2, 120e-6);
  const double strength = 2 * kCohesion * std::cos(kFriction) / (1 - std::sin(kFriction));
  EXPECT_NEAR(-bar.least / strength, 1, .02);
  const double wanted = kNet * kEnergy;
  EXPECT_GT(bar.world.ledger.plastic, 20 * wanted);
  EXPECT_EQ(bar.world.fracture.numCracks(), 0);
  bar.move(.2, 240e-6);
  EXPECT_EQ(wholePieces(bar.world).size(), 2);
  EXPECT_GT(bar.world.ledger.fracture, .98 * wanted);
  EXPECT_LT(bar.world.ledger.fracture, 1.7 * wanted);  // more edges open after this flow
  EXPECT_LT(std::abs(bar.energyError()), 3e-5);
}

TEST(Crushing, ABarIsCrushedBeforeItCracks) {
  for (const ElementKind kind : {ElementKind::kSmoothed, ElementKind::kLinear}) crush(kind, 4);
  crush(ElementKind::kLinear, 8);
}

/// Without a fracture energy tension flows at its limit; a failure strain then ends it at once.
TEST(Crushing, WithoutAFractureEnergyTensionFlows) {
  Bar flows(ElementKind::kLinear, 4, 0);
  flows.move(.04, 220e-6);
  EXPECT_EQ(flows.world.fracture.numCracks(), 0);
  EXPECT_GT(flows.world.ledger.plastic, 3 * kNet * kEnergy);
  Bar fails(ElementKind::kLinear, 4, 0, 5e-5);
  fails.move(.04, 220e-6);
  EXPECT_EQ(fails.world.ledger.fracture, 0);
  EXPECT_GE(wholePieces(fails.world).size(), 2);
  EXPECT_LT(std::abs(fails.energyError()), 1e-4);
}

}  // namespace
}  // namespace yadefrag::test
