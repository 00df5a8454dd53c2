// Brittle bodies with smoothed strains: at a node that splits the parts get strains of their own,
// and the ledger has what that changes.
#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>

#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

/// A plate of 40 × 20 mm whose short ends fly apart.
World plate(double fractureEnergy, ElementKind element, double minArea = 0) {
  World world;
  const TriangleMesh mesh = triangulate({{{0, 0}, {.04, 0}, {.04, .02}, {0, .02}}, {}}, 2e-3);
  BodySpec spec;
  spec.material = {32e9, .2, 2450, false};
  spec.brittle.tensileStrength = 3e6;
  spec.brittle.fractureEnergy = fractureEnergy;
  spec.brittle.strengthScatter = .1;
  spec.element = element;
  for (const Vec2& x : mesh.nodes) spec.velocity.push_back({100 * (x.x - .02), 20 * x.y});
  world.fracture.minFragmentArea = minArea;
  world.addBody(mesh, spec);
  return world;
}

double totalOf(const World& world) {
  return world.ledger.total(world.kineticEnergy(), world.strainEnergy());
}

/// Largest deviation of the total energy, relative to the strain energy that the body has had.
double energyError(World world, int steps) {
  const double dt = .5 * world.criticalTimeStep();
  const double start = world.kineticEnergy();
  double worst = 0, most = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    worst = std::max(worst, std::abs(totalOf(world) - start));
    most = std::max(most, world.strainEnergy());
  }
  EXPECT_GT(world.fracture.numCracks(), 20U);
  return worst / most;
}

TEST(SmoothedCracks, TheLedgerClosesOverEveryCrack) {
  for (const double fractureEnergy : {0., 3.})
    EXPECT_LT(energyError(plate(fractureEnergy, ElementKind::kSmoothed), 600),
              3 * energyError(plate(fractureEnergy, ElementKind::kLinear), 600) + 1e-6);
}

/// The step in which nodes first split: what the ledger has is what the strain energy gained.
TEST(SmoothedCracks, TheGainOfASplitNodeIsCountedInThatStep) {
  World world = plate(0, ElementKind::kSmoothed);
  const double dt = .5 * world.criticalTimeStep();
  const std::size_t nodes = world.model.nodes.size();
  const double start = world.kineticEnergy();
  double before = 0;
  while (world.model.nodes.size() == nodes) {
    before = totalOf(world);
    world.step(dt);
  }
  EXPECT_NEAR(totalOf(world), before, 1e-9 * start);
  EXPECT_LT(world.ledger.fracture, 0) << "a mean has no more energy than its parts";
  EXPECT_GT(world.ledger.fracture, -.1 * world.strainEnergy());
}

}  // namespace
}  // namespace yadefrag::test
