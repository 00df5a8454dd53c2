// Where the energy goes in a plate that is torn apart between its ends, held at its sides: 2 × 0.5
// mm of ceramic, pulled from both ends at 10⁵ 1/s with friction, on the mesh of addPolygon.
// Fragments are pressed against each other and against the sides when cracks unload them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

constexpr double kLong = 2e-3, kHigh = .5e-3, kRate = 1e5;  // m, m, 1/s

void addPlate(World& world, double size, std::uint64_t seed, double fractureEnergy) {
  const TriangleMesh mesh = triangulate({{{-kLong / 2, -kHigh / 2},
                                          {kLong / 2, -kHigh / 2},
                                          {kLong / 2, kHigh / 2},
                                          {-kLong / 2, kHigh / 2}},
                                         {}},
                                        size, {NodeLayout::kScattered, seed});
  BodySpec spec;
  spec.material = {275e9, .2, 2750, false};
  spec.friction = .3;
  spec.brittle.tensileStrength = 300e6;
  spec.brittle.fractureEnergy = fractureEnergy;
  spec.brittle.strengthScatter = .1;
  spec.brittle.seed = seed;
  hold(spec, mesh, kHeldX, [](Vec2 at) { return std::abs(at.x) > kLong / 2 - 1e-9; });
  hold(spec, mesh, kHeldY, [](Vec2 at) { return std::abs(at.y) > kHigh / 2 - 1e-9; });
  for (const Vec2 x : mesh.nodes) spec.velocity.push_back({kRate * x.x, 0});
  world.addBody(mesh, spec);
}

struct Balance {
  double worst = 0;  // largest change of the total
  double given = 0;  // most that contact has given back of what it had taken
};

/// Of the energy at the start, which is kinetic, in 0.5 µs and with 0.8 of the critical step.
Balance expand(World& world) {
  const double dt = .8 * world.criticalTimeStep(), start = world.kineticEnergy();
  Balance balance;
  double taken = 0;
  while (world.time < .5e-6) {
    world.step(dt);
    balance.worst = std::max(balance.worst, std::abs(totalEnergy(world) / start - 1));
    taken = std::max(taken, world.ledger.contact);
    balance.given = std::max(balance.given, (taken - world.ledger.contact) / start);
  }
  return balance;
}

class ConfinedExpansion : public testing::TestWithParam<std::uint64_t> {};

// Wanted: kinetic + strain + fracture + contact + friction − external, constant to 0.1 %, and no
// energy from contact. Measured: 3·10⁻⁷ with a fracture energy, 1.2·10⁻⁶ without, where strains
// are larger (the leapfrog's invariant neglects their square); contact takes 1 and 4 % and never
// gives back more than 7·10⁻⁶: what is let out of overlaps that are older than their contact.
TEST_P(ConfinedExpansion, KeepsItsEnergy) {
  for (const double fractureEnergy : {100., 0.}) {
    SCOPED_TRACE(fractureEnergy);
    World world;
    addPlate(world, 4e-5, GetParam(), fractureEnergy);
    const Balance balance = expand(world);
    const std::string name = fractureEnergy > 0 ? "" : "_opens_at_once";
    record("cracks" + name, static_cast<double>(world.fracture.numCracks()));
    record("external" + name, world.ledger.external / world.kineticEnergy());
    record("contact" + name, world.ledger.contact / world.kineticEnergy());
    record("friction" + name, world.ledger.friction / world.kineticEnergy());
    EXPECT_GT(world.fracture.numCracks(), 300U);
    figure("worst" + name, balance.worst, 0, 1e-5);
    EXPECT_GT(world.ledger.contact, 0);
    EXPECT_GT(world.ledger.friction, 0);
    figure("given_by_contact" + name, balance.given, 0, 1e-4);
    EXPECT_TRUE(world.warnings.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, ConfinedExpansion, testing::Values(1, 2, 3));

}  // namespace
}  // namespace yadefrag::test
