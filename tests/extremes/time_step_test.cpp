// From a thousandth of the critical time step to just above it; energy over very many steps.

#include <gtest/gtest.h>
#include <algorithm>

#include "extremes/block_collision.hpp"

namespace yadefrag::test {
namespace {

TEST(ExtremeTimeStep, FromAThousandthOfTheCriticalOne) {
  const Outcome usual = collide({.ofCritical = .1});
  double least = kNone, most = kNone;
  for (const double part : {1e-4, 1e-3, 1e-2, .1, .5, .9, .99, 1.}) {
    if (part < 1e-3 && !longRun()) continue;
    const Outcome outcome = collide({.ofCritical = part});
    EXPECT_TRUE(outcome.isSound()) << part << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, usual.left.x, .004) << part;
    if (part == 1e-3) least = part;
    most = part;
  }
  const std::string beyond = collide({.ofCritical = 1.0001}).refusal;
  EXPECT_NE(beyond.find("must be above 0 and at most"), std::string::npos) << beyond;
  limit("time step, of the critical one", least, most,
        "below: works, down to 10⁻⁴ at least; above: refused, with the critical step");
}

/// Two squares between four held walls, with contact all the time: growth of kinetic and strain
/// energy, of the start's.
double growthOver(int steps, double ofCritical) {
  World world;
  world.contactSettings.passes = 2;
  const auto add = [&](Vec2 low, Vec2 high, int nx, int ny, Vec2 velocity, bool held) {
    const TriangleMesh mesh = structuredRectangle(low, high, nx, ny);
    BodySpec spec = moving(mesh, rubber(), velocity);
    if (held) hold(spec, mesh, kHeldXY, [](Vec2) { return true; });
    world.addBody(mesh, spec);
  };
  add({-.2, -.2}, {2.5, 0}, 4, 1, {}, true);
  add({-.2, 1.3}, {2.5, 1.5}, 4, 1, {}, true);
  add({-.2, 0}, {0, 1.3}, 1, 2, {}, true);
  add({2.3, 0}, {2.5, 1.3}, 1, 2, {}, true);
  add({.1, .1}, {1.1, 1.1}, 2, 2, {3, 2}, false);
  add({1.2, .15}, {2.2, 1.15}, 3, 3, {-4, 1}, false);
  const double dt = ofCritical * world.criticalTimeStep();
  const double start = world.kineticEnergy();
  double most = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    if (i % 100 == 0)
      most = std::max(most, (world.kineticEnergy() + world.strainEnergy()) / start - 1);
  }
  return most;
}

TEST(ExtremeTimeStep, EnergyDoesNotGrow) {
  const int steps = longRun() ? 1'000'000 : 20'000;
  for (const double ofCritical : {.9, 1.}) EXPECT_LE(growthOver(steps, ofCritical), 1e-3);
  if (longRun())
    limit("steps over which energy grows by less than 10⁻³", kNone, steps, "not tried");
}

TEST(ExtremeTimeStep, AValueThatIsNotFiniteIsRefusedAndTheStateStays) {
  for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY)}) {
    World world = worldOf({});
    const double dt = .5 * world.criticalTimeStep();
    for (int i = 0; i < 10; ++i) world.step(dt);
    const std::vector<Vec2> before = world.model.nodes.position;
    world.model.nodes.velocity[3].x = bad;
    EXPECT_NE(sentenceOf([&] { world.step(dt); }), "") << bad;
    EXPECT_EQ(world.steps, 10U);
    for (std::size_t n = 0; n < before.size(); ++n)
      EXPECT_LE(norm(world.model.nodes.position[n] - before[n]), 1e-12) << bad << " node " << n;
    world.model.nodes.velocity[3].x = 0;
    EXPECT_EQ(sentenceOf([&] { world.step(dt); }), "") << "the run can go on";
  }
}

}  // namespace
}  // namespace yadefrag::test
