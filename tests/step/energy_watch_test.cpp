// Warnings: energy that numerical errors create.

#include "step/energy_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/checks.hpp"
#include "core/tolerances/step.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

EnergyWatch watchOf(double energy) {
  EnergyWatch watch;
  watch.begin(energy, {});
  return watch;
}

/// The message of the watch on contact and cracks.
std::string message(EnergyWatch& watch, const EnergyLedger& ledger, double noise = 0) {
  const WatchedStep step = stepOf(ledger);
  watch.count(step);
  return watch.mayHaveCreated(step) ? watch.contactMessage(step, noise) : "";
}

/// The message of the watch on the motion of bodies that have so much energy (J).
std::string saidOf(EnergyWatch& watch, double kinetic, double strain,
                   const EnergyLedger& ledger = {}, double noise = 0) {
  const WatchedStep step = stepOf(ledger);
  watch.count(step);
  if (!watch.mayHaveGrown(step, kinetic)) return {};
  return watch.growthMessage(step, kinetic + strain, noise);
}

TEST(EnergyWatch, ReportsOncePerDoubling) {
  EnergyWatch watch = watchOf(100);
  const auto contact = [&](double given) { return message(watch, {.contact = -given}); };
  EXPECT_EQ(contact(.9), "");
  EXPECT_EQ(contact(1.2),
            "Step 7, time 0.5 s: contact has created 1.2 J, 1.2 % of the bodies' energy; take a "
            "shorter step, which helps in about half of such scenes, or smaller elements where "
            "bodies touch.");
  for (const double quiet : {1.2, 1.5, 2.3}) EXPECT_EQ(contact(quiet), "");
  EXPECT_TRUE(contact(2.5).find("created 2.5 J") != std::string::npos);
  EXPECT_EQ(contact(4.9), "");
  EXPECT_NE(contact(5.1), "");
}

TEST(EnergyWatch, EarlierDissipationByContactHidesNothing) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(message(watch, {.contact = 30, .friction = 20}), "");
  EXPECT_NE(message(watch, {.contact = 28.5, .friction = 20}), "");
  EXPECT_NE(message(watch, {.contact = 28.5, .friction = 18}), "") << "friction";
}

TEST(EnergyWatch, FrictionMayTakeWhatContactGives) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(message(watch, {.contact = 30, .friction = -5}), "");
  EXPECT_EQ(message(watch, {.contact = 25, .friction = .5}), "");
  EXPECT_EQ(message(watch, {.contact = 30, .friction = -4.4}), "") << "the other way round";
  EXPECT_TRUE(
      contains(message(watch, {.contact = 27.9, .friction = -4.4}), "contact has created 2.1 J"));
}

/// As corners that jam did: the sum of both is right.
TEST(EnergyWatch, ReportsContactThatGivesMuchToFriction) {
  for (const bool byContact : {true, false}) {
    EnergyWatch watch = watchOf(100);
    EnergyLedger ledger;
    double& gives = byContact ? ledger.contact : ledger.friction;
    double& takes = byContact ? ledger.friction : ledger.contact;
    gives = 30;
    EXPECT_EQ(message(watch, ledger), "");
    gives = 23, takes = 8;
    const std::string said = message(watch, ledger);
    EXPECT_TRUE(contains(said, byContact ? "contact has given 7 J" : "friction has given 7 J"));
    EXPECT_TRUE(contains(said, "where corners jam"));
    gives = 22, takes = 9;
    EXPECT_EQ(message(watch, ledger), "") << "less than a doubling";
  }
}

/// No scene is known in which cohesive cracks create energy: the ledger is given.
TEST(EnergyWatch, CracksAreDistinguishedFromContact) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(message(watch, {.fracture = -3}),
            "Step 7, time 0.5 s: cohesive cracks have created 3 J, 3 % of the bodies' energy; a "
            "shorter step or smaller elements may help.");
  watch.split = 7;
  EXPECT_TRUE(
      contains(message(watch, {.fracture = -7}),
               "element='smoothed' have created 7 J, 7 % of the bodies' energy; the strains "
               "of elements that a crack separates"));
  // Contact and friction: their sum less both of them is below zero by rounding.
  EnergyWatch another = watchOf(100);
  EXPECT_TRUE(
      contains(message(another, {.contact = .2 * 8192, .friction = .5 * 8192, .fracture = -3}),
               "cracks have created 3 J"));
}

TEST(EnergyWatch, DoesNotReportRounding) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(message(watch, {.contact = -2}, 5), "");
  EXPECT_EQ(saidOf(watch, 102, 1, {}, 5), "");
  EXPECT_NE(saidOf(watch, 112, 1, {}, 5), "");
}

/// A body that goes takes its share of the energy along: what was given before is forgiven.
TEST(EnergyWatch, BeginsAnewWhenABodyGoes) {
  EnergyWatch watch = watchOf(100);
  const EnergyLedger ledger{.contact = -2};
  EXPECT_NE(message(watch, ledger), "");
  watch.begin(50, ledger);
  EXPECT_EQ(watch.most, 50);
  EXPECT_EQ(message(watch, ledger), "");
  EXPECT_EQ(saidOf(watch, 50.4, 0, ledger), "");
  EXPECT_NE(message(watch, {.contact = -2.7}), "");
}

TEST(EnergyWatch, SumsUpWhereBodiesMoveWithMoreThanThereIs) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(saidOf(watch, 100.9, 1), "");
  EXPECT_EQ(saidOf(watch, 110, -9.1), "") << "lent by the strain";
  EXPECT_EQ(saidOf(watch, 110.5, 50), "") << "looked at already";
  EXPECT_EQ(saidOf(watch, 112, -10),
            "Step 7, time 0.5 s: the time integration has created 2 J, 2 % of the bodies' energy; "
            "take a shorter step: in one of 0.1 s the bodies rotate or deform too much.");
  EXPECT_EQ(saidOf(watch, 130, -26.1), "");
  EXPECT_NE(saidOf(watch, 150, -45.5), "") << "doubled";
}

TEST(EnergyWatch, SumsUpFromTimeToTimeWhateverTheMotion) {
  EnergyWatch watch = watchOf(100);
  const EnergyLedger ledger;
  WatchedStep step = stepOf(ledger);
  EXPECT_FALSE(watch.mayHaveGrown(step, 10));
  step.step = tolerance::kStepsToSumUp;
  EXPECT_TRUE(EnergyWatch::isDue(step.step) && watch.mayHaveGrown(step, 10));
}

TEST(EnergyWatch, DissipatedEnergyCannotBeReleased) {
  EnergyWatch watch = watchOf(100);
  EXPECT_EQ(saidOf(watch, 60, 0, {.contact = 40}), "");
  EXPECT_NE(saidOf(watch, 60, 0, {.contact = 45}), "");
  EXPECT_EQ(saidOf(watch, 150, 0, {.external = 50}), "") << "work from outside";
  EXPECT_EQ(saidOf(watch, 52, 0, {.friction = 99, .external = 50}), "") << "of all that came in";
}

/// A message about bodies at rest is in joules, and does not suppress messages once they move.
TEST(EnergyWatch, ReportsAtRestHideNoLaterOnes) {
  EnergyWatch watch = watchOf(1e-20);
  EXPECT_NE(saidOf(watch, 7e-18, 0), "");
  EXPECT_EQ(saidOf(watch, 100, 0, {.external = 100}), "");
  EXPECT_TRUE(contains(saidOf(watch, 121, 0, {.external = 100}), "21 J, 21 %"));
}

TEST(EnergyWatch, ReportsAStepThatChangesOften) {
  EnergyWatch watch = watchOf(100);
  const EnergyLedger ledger;
  WatchedStep step = stepOf(ledger);
  for (const double dt : {.1, .2, .05, .1}) step.dt = dt, watch.count(step);
  const std::string sentence = watch.growthMessage(step, 110, 0);
  EXPECT_TRUE(
      contains(sentence,
               "keep the time step constant, or below a third of the critical one: changing "
               "often between 0.05 and 0.2 s"));
  EXPECT_LT(sentence.size(), 300U);
  step.step = 10000;
  EXPECT_TRUE(contains(watch.growthMessage(step, 130, 0), "take a shorter step"))
      << "that was long ago";
}

/// A square of four triangles that spins and spreads, its corners at `part` of the wave speed, in
/// steps of 0.99 of the critical one.
World spreading(double part) {
  World world;
  const TriangleMesh mesh = structuredRectangle({-.5, -.5}, {.5, .5}, 1, 1, QuadPattern::kCrossed);
  BodySpec spec = moving(mesh, steel(), {});
  spec.selfContact = false;
  const double rate = part * std::sqrt(2 * steel().waveModulus() / steel().density);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const auto [x, y] = mesh.nodes[i];
    spec.velocity[i] = rate * Vec2{x - y, .3 * y + x};
  }
  world.addBody(mesh, spec);
  stepFor(world, .99, 200);
  return world;
}

TEST(EnergyWatch, ReportsAStepThatIsTooLong) {
  for (const double part : {1e-3, .01, .05}) {
    const World world = spreading(part);
    EXPECT_TRUE(world.warnings.empty()) << part << ": " << world.warnings.front();
  }
  const World fast = spreading(1.5);
  ASSERT_FALSE(fast.warnings.empty());
  EXPECT_TRUE(contains(fast.warnings.front(), "% of the bodies' energy; take a shorter step"));
}

/// A square that shakes by rounding and `speed` (m/s) without any pattern.
World shaking(double speed, Vec2 low, double size) {
  World world;
  const TriangleMesh mesh =
      structuredRectangle(low, low + Vec2{size, size}, 7, 7, QuadPattern::kCrossed);
  BodySpec spec = moving(mesh, steel(), {});
  spec.selfContact = false;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-speed, speed);
  for (Vec2& velocity : spec.velocity) velocity = {any(random), any(random)};
  world.addBody(mesh, spec);
  return world;
}

double energyOf(const World& world) { return world.kineticEnergy() + world.strainEnergy(); }

/// Steps drawn anew between parts of the critical one, until energy has grown so many times.
void vary(World& world, double least, double most, int steps, double growth) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(least, most);
  const double critical = world.criticalTimeStep();
  world.step(most * critical);
  const double start = energyOf(world);
  for (int i = 1; i < steps && energyOf(world) < growth * start; ++i)
    world.step(part(random) * critical);
}

/// At each change of the step the sum was begun anew.
TEST(EnergyWatch, ReportsStepsThatChangeAllTheTime) {
  World world = shaking(.01, {}, .01);
  vary(world, .27, .9, 4000, 50);
  ASSERT_FALSE(world.warnings.empty());
  EXPECT_TRUE(contains(world.warnings.front(), "keep the time step constant"));
  EXPECT_LT(world.warnings.size(), 14U);
  World slow = shaking(.01, {}, .01);
  vary(slow, .05, .2, 4000, 50);
  EXPECT_TRUE(slow.warnings.empty()) << slow.warnings.front();
}

/// Rounding shakes a body at rest, more and more.
TEST(EnergyWatch, BodiesAtRestGiveNoMessage) {
  for (const Vec2 low : {Vec2{.3, .3}, Vec2{-.35, -.35}, Vec2{17.3, 3}, Vec2{1000, 1000}})
    for (const double ofCritical : {.8, .05}) {
      World world = shaking(0, low, .7);
      stepFor(world, ofCritical, 10000);
      EXPECT_TRUE(world.warnings.empty()) << world.warnings.front();
      EXPECT_LT(energyOf(world), .1 * world.roundingEnergy()) << low.x << ' ' << ofCritical;
      if (low.x < 1 && ofCritical > .5) {
        EXPECT_GT(energyOf(world), .01 * world.roundingEnergy()) << low.x;
      }
    }
}

/// After all that rounding has made of it.
TEST(EnergyWatch, GrowthIsReportedAfterALongRest) {
  World world = shaking(0, {.3, .3}, .7);
  const double dt = .8 * world.criticalTimeStep();
  for (int i = 0; i < 6000; ++i) world.step(dt);
  std::vector<Vec2> push(world.model.nodes.size());
  push.front() = {1e4, 2e3};
  for (int i = 0; i < 100; ++i) {
    world.loads.outerForces = push;
    world.step(dt);
  }
  EXPECT_TRUE(world.warnings.empty()) << world.warnings.front();
  vary(world, .27, .9, 4000, 2);
  EXPECT_FALSE(world.warnings.empty());
}

/// Bodies that come all the time, with steps of `least` to `most` of the critical one.
World joined(double least, double most, Vec2 velocity) {
  World world = shaking(.01, {}, .01);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(least, most);
  const double critical = world.criticalTimeStep();
  for (int i = 0; i < 1000 && world.warnings.empty(); ++i) {
    world.step(part(random) * critical);
    if (i % 50 != 0) continue;
    const int number = i / 50 + 1;
    const Vec2 low{.02 * number, 0};
    addMoving(world, structuredRectangle(low, low + Vec2{.01, .01}, 2, 2), steel(), velocity);
  }
  return world;
}

/// (J) What the watch expects the bodies to have: bodies that come bring their energy from outside.
double expectedBy(const World& world) {
  return world.watch.expected + world.ledger.external - world.watch.gone;
}

/// Each body that comes brings its energy along; the sum goes on.
TEST(EnergyWatch, NewcomersDoNotBeginTheSumAnew) {
  EXPECT_FALSE(joined(.27, .9, {}).warnings.empty());
  const World quiet = joined(.8, .8, {0, 1});
  EXPECT_TRUE(quiet.warnings.empty()) << quiet.warnings.front();
  EXPECT_GT(energyOf(quiet), 5);
  EXPECT_NEAR(expectedBy(quiet) / energyOf(quiet), 1, 1e-8);
}

TEST(EnergyWatch, RemovedBodiesTakeTheirEnergyAway) {
  World world = joined(.8, .8, {0, 1});
  const double before = energyOf(world), dt = world.lastDt;
  world.removeBody(ComponentId(3));
  EXPECT_LT(expectedBy(world), .96 * before);
  for (int i = 0; i < 2000; ++i) world.step(dt);
  EXPECT_NEAR(expectedBy(world) / energyOf(world), 1, 1e-8);
  EXPECT_TRUE(world.warnings.empty());
}

}  // namespace
}  // namespace yadefrag::test
