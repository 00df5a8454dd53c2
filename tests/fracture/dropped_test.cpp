// Small fragments that are taken out: nothing is lost but what is booked, and nothing of them acts
// any more.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "fracture/overlaps.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"
#include "step/world.hpp"

namespace yadefrag::test {
namespace {

constexpr double kArea = 1.5e-6;  // m²: about three triangles

/// The block is held at its bottom or free.
World impactOf(double fractureEnergy, bool held, double area) {
  World world = impact({.fractureEnergy = fractureEnergy, .held = held});
  world.fracture.minFragmentArea = area;
  return world;
}

bool isHeldPiece(const World& world, std::span<const std::uint32_t> pieces, std::uint32_t piece) {
  for (std::uint32_t e = 0; e < pieces.size(); ++e) {
    if (pieces[e] != piece) continue;
    for (const NodeId node : world.model.triangles.nodes[e])
      if (world.model.nodes.held[node.value] != kFree) return true;
  }
  const CrackEdges& edges = world.fracture.edges;
  return std::ranges::any_of(world.fracture.cohesion.edge, [&](EdgeId edge) {
    const std::uint32_t a = pieces[edges.side(edge, 0).element.value];
    const std::uint32_t b = pieces[edges.side(edge, 1).element.value];
    return a != b && (a == piece || b == piece);
  });
}

/// Pieces of the block below the area that nothing holds, by nodes alone.
std::size_t loosePieces(const World& world, double area) {
  const std::vector<std::uint32_t> pieces = piecesOf(world.model);
  std::vector<double> areas(pieces.size());
  for (std::size_t e = 0; e < world.model.components[0].lastTriangle; ++e)
    areas[pieces[e]] += world.model.triangles.area[e];
  std::size_t count = 0;
  for (std::uint32_t piece = 0; piece < areas.size(); ++piece)
    if (areas[piece] > 0 && areas[piece] < area && !isHeldPiece(world, pieces, piece)) ++count;
  return count;
}

/// Dropped triangles rest where they are without stress, without contact and cracks.
void expectInert(const World& world) {
  const Model& model = world.model;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes.mass[n] == 0) {
      EXPECT_EQ(model.nodes.position[n], world.model.nodes.reference[n]);
      EXPECT_EQ(model.nodes.velocity[n], Vec2{});
    }
  const auto isGone = [&](EntryId entry) { return world.surfaces.isGone(entry); };
  const Candidates& candidates = world.contact.candidates;
  EXPECT_TRUE(std::ranges::none_of(candidates.slaves, isGone));
  EXPECT_TRUE(std::ranges::none_of(candidates.masters, isGone));
  for (std::size_t s = 0; s < world.surfaces.segments(); ++s)
    EXPECT_EQ(world.surfaces.isGone(SegmentId(s)),
              model.nodes.mass[world.surfaces.segmentNode[s].value] == 0);
  for (const EdgeId edge : world.fracture.cohesion.edge)
    EXPECT_FALSE(model.triangles.isDropped(world.fracture.edges.side(edge, 0).element.value));
}

std::size_t cracksInDropped(const World& world) {
  const CrackEdges& edges = world.fracture.edges;
  std::size_t count = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.cracked[i] != 0 && world.model.triangles.isDropped(edges.element[i][0].value) &&
        world.model.triangles.isDropped(edges.element[i][1].value))
      ++count;
  return count;
}

class DropFragments : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(FractureEnergies, DropFragments, testing::Values(0., 200.));

TEST_P(DropFragments, OnlyCountedQuantitiesAreLost) {
  World world = impactOf(GetParam(), false, kArea);
  const double dt = .8 * world.criticalTimeStep();
  const double energy = world.kineticEnergy();
  const Sums start = sumsOf(world.model);
  double drift = 0, massError = 0, momentumError = 0;
  std::uint64_t count = 0;
  std::size_t cracksBefore = 0, cracksIn = 0;
  for (int i = 0; i < 400; ++i) {
    world.step(dt);
    const Sums sums = sumsOf(world.model);
    massError = std::max(massError, std::abs((sums.mass + world.dropped.mass) / start.mass - 1));
    momentumError =
        std::max(momentumError, norm(sums.momentum + world.dropped.momentum - start.momentum) /
                                    norm(start.momentum));
    drift = std::max(drift, std::abs(totalEnergy(world) / energy - 1));
    // No edge of a dropped fragment cracks in a step in which none goes.
    cracksIn = cracksInDropped(world);
    if (world.dropped.count == count) {
      EXPECT_EQ(cracksIn, cracksBefore);
    }
    cracksBefore = cracksIn, count = world.dropped.count;
    if (i % 20 == 0) {
      EXPECT_EQ(loosePieces(world, kArea), 0U) << i;
    }
  }
  expectInert(world);
  EXPECT_GT(count, 5U);
  EXPECT_GT(world.dropped.mass, 0);
  EXPECT_GT(world.ledger.dropped, 0);
  record("dropped", static_cast<double>(count));
  record("dropped_mass", world.dropped.mass / start.mass);
  record("dropped_energy", world.ledger.dropped / energy);
  // As without dropping (impact_test.cpp).
  figure("mass_error", massError, 0, 1e-12);
  figure("momentum_error", momentumError, 0, 1e-12);
  figure("energy_drift", drift, 0, .01);
}

// Up to the first fragment that goes, and but for it in that step, both runs are one.
TEST_P(DropFragments, TheLedgerClosesInTheStepItself) {
  World with = impactOf(GetParam(), true, kArea), without = impactOf(GetParam(), true, 0);
  const double dt = .8 * with.criticalTimeStep();
  while (with.dropped.count == 0 && with.steps < 1000) {
    EXPECT_TRUE(sameBits(with.model.nodes.position, without.model.nodes.position));
    with.step(dt), without.step(dt);
  }
  ASSERT_GT(with.dropped.count, 0U);
  const double scale = totalEnergy(without);
  // Sums of 10³ terms of either sign.
  EXPECT_NEAR(totalEnergy(with) / scale, 1, 1e-13);
  EXPECT_EQ(without.dropped.count, 0U);
  EXPECT_EQ(without.ledger.dropped, 0);
}

TEST(DropFragmentsOf, ALargerAreaTakesWhatIsThereAlready) {
  World world = impactOf(0, true, 0);
  const double dt = .8 * world.criticalTimeStep();
  for (int i = 0; i < 150; ++i) world.step(dt);
  const std::size_t loose = loosePieces(world, kArea);
  ASSERT_GT(loose, 3U);
  world.fracture.minFragmentArea = kArea;
  world.step(dt);
  EXPECT_GE(world.dropped.count, loose);
  EXPECT_EQ(loosePieces(world, kArea), 0U);
  expectInert(world);
  // They do not move again.
  const std::vector<NodeId> all = nodesWhere(world.model.nodes, [](Vec2) { return true; });
  world.prescribe(all, kFree, {});
  world.setLoads(std::vector<Vec2>(all.size(), {1, 1}));
  world.dynamicsSettings.gravity = {0, -10};
  for (int i = 0; i < 150; ++i) world.step(dt);
  expectInert(world);
  EXPECT_TRUE(std::isfinite(totalEnergy(world)));
  EXPECT_GT(world.criticalTimeStep(), dt);
}

// A body that is smaller than the area is no fragment of anything; and what is held is not loose.
TEST(DropFragmentsOf, WholeAndHeldBodiesStay) {
  World whole = impactOf(0, false, 1);
  const double dt = .8 * whole.criticalTimeStep();
  // Cracked already, but in one piece, which is "small".
  while (whole.steps < 1000 && loosePieces(whole, 1) == 1) {
    EXPECT_EQ(whole.dropped.count, 0U);
    whole.step(dt);
  }
  EXPECT_GT(whole.steps, 2U);
  EXPECT_GT(whole.fracture.numCracks(), 0U);
  EXPECT_GT(whole.dropped.count, 0U);

  World held = impactOf(0, true, 1);  // every fragment of it is small
  for (int i = 0; i < 300; ++i) held.step(dt);
  EXPECT_GT(held.dropped.count, 5U);
  std::size_t bottom = 0;
  for (std::size_t n = 0; n < held.model.nodes.size(); ++n) {
    if (held.model.nodes.reference[n].y > -.01 + 1e-9) continue;
    ++bottom;
    EXPECT_GT(held.model.nodes.mass[n], 0);
  }
  EXPECT_GT(bottom, 10U);
}

// --- Brittle bodies with smoothed strains: at a node that splits the parts get strains of their
// own, and the ledger has what that changes.

/// A plate of 40 × 20 mm whose short ends fly apart.
World plate(double fractureEnergy, ElementKind element) {
  World world;
  const TriangleMesh mesh = triangulate(rectangle({0, 0}, {.04, .02}), 2e-3);
  BodySpec spec = brittle({32e9, .2, 2450, false}, 3e6, fractureEnergy);
  spec.brittle.strengthScatter = .1;
  spec.element = element;
  for (const Vec2& x : mesh.nodes) spec.velocity.push_back({100 * (x.x - .02), 20 * x.y});
  world.addBody(mesh, spec);
  return world;
}

/// Largest deviation of the total energy, relative to the strain energy that the body has had.
double energyError(World world, int steps) {
  const double dt = .5 * world.criticalTimeStep();
  const double start = world.kineticEnergy();
  double worst = 0, most = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    worst = std::max(worst, std::abs(totalEnergy(world) - start));
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
    before = totalEnergy(world);
    world.step(dt);
  }
  EXPECT_NEAR(totalEnergy(world), before, 1e-9 * start);
  EXPECT_LT(world.ledger.fracture, 0) << "a mean has no more energy than its parts";
  EXPECT_GT(world.ledger.fracture, -.1 * world.strainEnergy());
}

}  // namespace
}  // namespace yadefrag::test
