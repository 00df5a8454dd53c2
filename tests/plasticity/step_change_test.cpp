// The energy balance of a body that yields where the step becomes shorter, as FESolver makes it
// when flow flattens triangles.

#include <gtest/gtest.h>

#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

TEST(StepChange, OfABodyThatYieldsAddsNoEnergy) {
  for (const ElementKind kind : {ElementKind::kLinear, ElementKind::kSmoothed}) {
    World world;
    world.addBody(turnedMesh({{{0, 0}, {.02, 0}, {.02, .02}, {0, .02}}, {}}, .002, 0),
                  idealSteel(300e6, kind));
    for (std::size_t n = 0; n < world.model.nodes.size(); ++n) {
      const Vec2 x = world.model.nodes.reference[n];
      world.model.nodes.velocity[n] = {2e3 * x.x, -40 * std::sin(150 * x.x)};
    }
    const double start = world.kineticEnergy();
    const auto total = [&] {
      return world.ledger.total(world.kineticEnergy(), world.strainEnergy()) +
             world.pendingPlastic();
    };
    double dt = .9 * world.criticalTimeStep();
    for (int i = 0; i < 10; ++i) world.step(dt);
    EXPECT_GT(world.ledger.plastic, .03 * start);
    const double before = total();
    for (int change = 0; change < 3; ++change) {
      dt *= .6;
      for (int i = 0; i < 5; ++i) world.step(dt);
    }
    // That of the highest modes between two half steps.
    EXPECT_GT(std::abs(world.ledger.external), 1e-4 * start);
    EXPECT_NEAR(total(), before, 1e-5 * start);
  }
}

}  // namespace
}  // namespace yadefrag::test
