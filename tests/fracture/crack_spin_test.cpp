// Cohesive tractions create no angular momentum, whatever the law, and this costs no energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fracture/two_triangles.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

struct Law {
  double beta = 1, kappa = 1, energy = 2000, friction = 0;
  const char* curve = "linear";
};

double spinOf(const World& world) { return momentsOf(world.model.nodes).angular; }

/// A free block tears by its velocities, apart and along the line between its halves (m/s).
struct Torn {
  Torn(const Law& law, Vec2 apart) {
    const TriangleMesh mesh =
        triangulate({{{-.01, -.01}, {.01, -.01}, {.01, .01}, {-.01, .01}}, {}}, 2.5e-3,
                    {NodeLayout::kScattered, 1});
    BodySpec spec;
    spec.material = {1e9, .2, 2000, false};
    spec.friction = law.friction;
    spec.brittle.tensileStrength = 1e6;
    spec.brittle.fractureEnergy = law.energy;
    spec.brittle.shearFactor = law.beta;
    spec.brittle.shearEnergyFactor = law.kappa;
    spec.brittle.softening = softeningNamed(law.curve);
    for (const Vec2 x : mesh.nodes) spec.velocity.push_back((x.y > 0 ? 1. : -1.) * apart);
    world.addBody(mesh, spec);
    dt = .5 * world.criticalTimeStep();
    world.step(dt);
    spin = spinOf(world), energy = totalEnergy(world);
    size = sumOfSpins(world.model.nodes);
  }

  void run(double duration) {
    while (world.time < duration) {
      world.step(dt);
      worstSpin = std::max(worstSpin, std::abs(spinOf(world) - spin));
      worstEnergy = std::max(worstEnergy, std::abs(totalEnergy(world) - energy));
    }
  }

  World world;
  double dt, spin, energy, size, worstSpin = 0, worstEnergy = 0;
};

// Two triangles part obliquely, with and without friction: nothing but the law acts, so that only
// rounding is left.
TEST(CrackSpin, AnEdgeThatOpensObliquelyKeepsTheAngularMomentum) {
  for (const auto& [name, curve] : softeningCurves())
    for (const Law& law : {Law{1}, Law{3}, Law{.5}, Law{3, 4}, Law{3, 1, 0, .6}}) {
      BodySpec spec;
      spec.friction = law.friction;
      spec.brittle.shearFactor = law.beta;
      spec.brittle.shearEnergyFactor = law.kappa;
      spec.brittle.softening = curve;
      World world;
      addTwoTriangles(world, spec, 1.3);
      world.step(1e-11);
      Nodes& nodes = world.model.nodes;
      for (std::size_t element = 0; element < 2; ++element)
        for (const NodeId node : world.model.triangles.nodes[element])
          nodes.velocity[node.value] += (element == 0 ? -1. : 1.) * Vec2{30, 60};
      const double spin = spinOf(world), size = sumOfSpins(nodes), energy = totalEnergy(world);
      double worst = 0;
      for (int n = 0; n < 3000; ++n) {
        world.step(1e-11);
        worst = std::max(worst, std::abs(spinOf(world) - spin));
      }
      EXPECT_GT(world.ledger.fracture, .1 * kEnergy * kArea) << name;
      EXPECT_LT(worst, 1e-11 * size) << name << ' ' << law.beta << ' ' << law.kappa;
      EXPECT_NEAR(totalEnergy(world), energy, 1e-6 * kEnergy * kArea) << name;
    }
}

// Fragments that collide: their contact alone, without a fracture energy, creates up to 2.4·10⁻⁶ of
// Σ m r v; without the couple it was 3·10⁻⁴ with β = 1 and Gc = 500, 5·10⁻² with 3 and 2000.
TEST(CrackSpin, AFreeBlockThatTearsKeepsItsAngularMomentum) {
  for (const Law& law :
       {Law{}, Law{1, 1, 500}, Law{3}, Law{.5}, Law{3, 4}, Law{1, 1, 2000, .6}, Law{3, 1, 500, .6},
        Law{3, 1, 2000, 0, "petersson"}, Law{3, 1, 2000, .6, "exponential"}}) {
    Torn torn(law, {3, 10});
    torn.run(4e-4);
    EXPECT_GT(torn.world.fracture.numCracks(), 50U);
    EXPECT_LT(torn.worstSpin, 3e-6 * torn.size)
        << law.beta << ' ' << law.energy << ' ' << law.curve;
    EXPECT_LT(torn.worstEnergy, 1e-4 * torn.energy) << law.beta << ' ' << law.energy;
    EXPECT_TRUE(torn.world.warnings.empty());
  }
}

// What the ledger counts is what is there: contact may create some, as much as it counts.
TEST(CrackSpin, TheLedgerCountsWhatIsCreated) {
  Torn torn({2, 1, 500, .6}, {20, -5});
  const double begin = torn.world.ledger.spin;
  torn.run(2e-4);
  EXPECT_NEAR(torn.world.ledger.spin - begin, spinOf(torn.world) - torn.spin, 1e-9 * torn.size);
}

TEST(EnergyWatch, TellsOfCreatedAngularMomentumOnce) {
  EnergyLedger ledger;
  EnergyWatch watch;
  const WatchedStep step{8, 1e-6, 1e-7, 0, 1e-3, 1e-3, ledger};
  EXPECT_FALSE(watch.mayHaveSpun(step));
  ledger.spin = 5e-4;
  EXPECT_TRUE(watch.mayHaveSpun(step));
  EXPECT_EQ(watch.spinMessage(step, 1), "");
  EXPECT_FALSE(watch.mayHaveSpun(step));  // nothing is evaluated again
  ledger.spin = -2e-3;
  EXPECT_NE(watch.spinMessage(step, 1).find("0.2 % of the sum of m r v; take a shorter step, "
                                            "which helps in about half"),
            std::string::npos);
  EXPECT_FALSE(watch.mayHaveSpun(step));
  ledger.spin = -5e-3;
  EXPECT_NE(watch.spinMessage(step, 1), "");
}

}  // namespace
}  // namespace yadefrag::test
