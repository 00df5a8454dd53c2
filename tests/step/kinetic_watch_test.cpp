// Bodies that move with more energy than there is: a step that cannot follow them is told.

#include "step/kinetic_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

TEST(KineticWatch, AsksForALookAndTellsOncePerDoubling) {
  KineticWatch watch;
  EXPECT_TRUE(watch.isNew(.1));
  watch.begin(.1, 100, 100);
  EXPECT_FALSE(watch.isNew(.1));
  EXPECT_TRUE(watch.isNew(.2)) << "another step has another energy";
  EXPECT_FALSE(watch.isSuspicious(100.9, 0));
  EXPECT_TRUE(watch.isSuspicious(110, 0));
  EXPECT_FALSE(watch.isSuspicious(110.5, 0)) << "looked at already";
  EXPECT_EQ(watch.excess(100.9, 0, 0), 0) << "lent by the strain";
  EXPECT_NEAR(watch.tell(watch.excess(102, 0, 0)), .02, 1e-15);
  EXPECT_EQ(watch.excess(103.9, 0, 0), 0);
  EXPECT_NEAR(watch.excess(104.5, 0, 0), 4.5, 1e-12);
  EXPECT_EQ(watch.excess(104.5, 0, 5), 0) << "rounding";
  watch.restart();
  EXPECT_TRUE(watch.isNew(.1));
}

TEST(KineticWatch, WhatWasSpentIsThereNoMore) {
  KineticWatch watch;
  watch.begin(.1, 100, 100);
  EXPECT_FALSE(watch.isSuspicious(60, 40));
  EXPECT_TRUE(watch.isSuspicious(60, 45));
  EXPECT_FALSE(watch.isSuspicious(150, -50)) << "work from outside";
  EXPECT_FALSE(watch.isSuspicious(1.5, 99)) << "of the largest energy so far, not of what is left";
  EXPECT_NEAR(watch.excess(65, 45, 0), 10, 1e-12);
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
  const double dt = .99 * world.criticalTimeStep();
  for (int i = 0; i < 200; ++i) world.step(dt);
  return world;
}

TEST(KineticWatch, TellsOfAStepThatCannotFollow) {
  for (const double part : {1e-3, .01, .05}) {
    const World world = spreading(part);
    EXPECT_TRUE(world.complaints.empty()) << part << ": " << world.complaints.front();
  }
  const World fast = spreading(1.5);
  ASSERT_FALSE(fast.complaints.empty());
  EXPECT_NE(fast.complaints.front().find("out of nothing; take a shorter step"), std::string::npos)
      << fast.complaints.front();
}

}  // namespace
}  // namespace yadefrag::test
