// Energy that contact makes out of nothing is told, and so are bodies that sink into one another.

#include "step/energy_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

WatchedStep stepOf(const EnergyLedger& ledger, bool isPenalty = false) {
  return {7, .5, isPenalty, 0, 1, .5, ledger};
}

/// What the watch says of bodies that have 100 J.
std::string said(EnergyWatch& watch, const WatchedStep& step, double noise = 0) {
  return watch.isSuspicious(step) ? watch.complain(step, 60, 40, noise) : "";
}

TEST(EnergyWatch, TellsOncePerDoubling) {
  EnergyWatch watch;
  EnergyLedger ledger;
  const auto contact = [&](double given) {
    ledger.contact = -given;
    return said(watch, stepOf(ledger));
  };
  EXPECT_EQ(contact(.9), "");
  EXPECT_EQ(contact(1.2),
            "Step 7, time 0.5 s: contact has created 1.2 J, 1.2 % of the bodies' energy; take a "
            "shorter step, or smaller elements where bodies touch.");
  for (const double quiet : {1.2, 1.5, 2.3}) EXPECT_EQ(contact(quiet), "");
  EXPECT_TRUE(contact(2.5).find("created 2.5 J") != std::string::npos);
  EXPECT_EQ(contact(4.9), "");
  EXPECT_NE(contact(5.1), "");
}

TEST(EnergyWatch, WhatContactTookBeforeHidesNothing) {
  EnergyWatch watch;
  EnergyLedger ledger;
  ledger.contact = 30, ledger.friction = 20;
  EXPECT_EQ(said(watch, stepOf(ledger)), "");
  ledger.contact = 28.5;
  EXPECT_NE(said(watch, stepOf(ledger)), "");
  ledger.friction = 18;
  EXPECT_NE(said(watch, stepOf(ledger)), "") << "friction";
}

TEST(EnergyWatch, APenaltyMayGiveBackWhatItTook) {
  EnergyWatch watch;
  EnergyLedger ledger;
  for (const double stored : {0., 30., 5., 0., -.5}) {
    ledger.contact = stored;
    EXPECT_EQ(said(watch, stepOf(ledger, true)), "") << stored;
  }
  ledger.contact = -2;
  EXPECT_TRUE(
      said(watch, stepOf(ledger, true)).ends_with("Lagrangian correction, or a shorter step."));
}

TEST(EnergyWatch, CracksAreToldApart) {
  EnergyWatch watch;
  EnergyLedger ledger;
  ledger.fracture = -3;
  EXPECT_TRUE(said(watch, stepOf(ledger)).find("cracks that still hold have created 3 J") !=
              std::string::npos);
}

TEST(EnergyWatch, SparesWhatRoundingMakes) {
  EnergyWatch watch;
  EnergyLedger ledger;
  ledger.contact = -2;
  EXPECT_EQ(said(watch, stepOf(ledger), 5), "");
}

/// A body that goes takes its share of the energy along: what was given before is forgiven.
TEST(EnergyWatch, BeginsAnewWhenABodyGoes) {
  EnergyWatch watch;
  EnergyLedger ledger;
  ledger.contact = -2;
  EXPECT_NE(said(watch, stepOf(ledger)), "");
  watch.forget(ledger);
  EXPECT_EQ(said(watch, stepOf(ledger)), "");
  ledger.contact = -3.5;
  EXPECT_NE(said(watch, stepOf(ledger)), "");
}

TEST(EnergyWatch, TellsOfDepth) {
  EnergyWatch watch;
  const EnergyLedger ledger;
  WatchedStep step = stepOf(ledger, true);
  const auto deep = [&](double depth) {
    step.depth = depth;
    return watch.complainOfDepth(step);
  };
  EXPECT_EQ(deep(.09), "");
  EXPECT_EQ(deep(.2),
            "Step 7, time 0.5 s: bodies are in one another by 0.2 m, 0.2 of the shortest segment; "
            "take the Lagrangian correction, or a larger penalty factor.");
  EXPECT_EQ(deep(.3), "");
  EXPECT_NE(deep(.5), "");
  watch.toldDepth = 0, step.halo = .06;
  EXPECT_EQ(deep(.02), "");
  EXPECT_NE(deep(.04), "") << "soon lost by a smooth surface";
}

/// Two blocks that meet at 20 m/s, of which one stands.
World blow(const ContactSettings& settings, int steps) {
  World world;
  world.contactSettings = settings;
  for (int k = 0; k < 2; ++k) {
    const Vec2 low{.01 * k, -.001 * k};
    const TriangleMesh mesh =
        structuredRectangle(low, low + Vec2{.01, .01}, 6 + k, 6 + k, QuadPattern::kCrossed);
    BodySpec spec = moving(mesh, steel(), {k == 0 ? 20. : 0., 0});
    world.addBody(mesh, spec);
  }
  const double dt = .8 * world.criticalTimeStep();
  while (world.steps < static_cast<std::uint64_t>(steps)) world.step(dt);
  return world;
}

TEST(EnergyWatch, HealthyBlowsAreQuiet) {
  for (const int passes : {1, 2})
    for (const Correction correction : {Correction::kLagrange, Correction::kPenalty}) {
      const World world = blow({correction, passes}, 400);
      EXPECT_GT(world.ledger.contact, 0);
      EXPECT_TRUE(world.complaints.empty()) << world.complaints.front();
    }
}

/// A ten-thousandth of the stiffness that would undo a penetration in a step: they sink.
TEST(EnergyWatch, ASoftPenaltyIsTold) {
  const World world = blow({Correction::kPenalty, 1, 1e-4}, 400);
  ASSERT_FALSE(world.complaints.empty());
  EXPECT_TRUE(world.complaints.front().find("bodies are in one another by") != std::string::npos)
      << world.complaints.front();
  EXPECT_LT(world.complaints.size(), 8U);
}

}  // namespace
}  // namespace yadefrag::test
