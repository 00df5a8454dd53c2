// Blocks that touch exactly, with friction and gravity: nearly all rows are redundant, and one
// group has hundreds of them. Exact solves for given bounds of friction took 1 s a step for 36
// blocks.

#include "step/blocks.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <algorithm>

#include "core/tolerances/solver.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

class TouchingBlocks : public testing::TestWithParam<int> {
 protected:
  void build(const BlockWall& wall) {
    world_.contactSettings.passes = GetParam();
    addBlockWall(world_, wall);
    dt_ = .8 * world_.criticalTimeStep();
  }
  World world_;
  double dt_ = 0;
};

/// From the first step on, and while waves of gravity's onset go through the wall.
TEST_P(TouchingBlocks, AreSolvedInFewSweeps) {
  build({6});
  int most = 0;
  std::uint64_t sum = 0;
  std::size_t rows = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    world_.step(dt_);
    most = std::max(most, world_.contact.sweeps());
    sum += static_cast<std::uint64_t>(world_.contact.sweeps());
    rows = std::max(rows, world_.contact.rows().size());
  }
  EXPECT_GE(rows, 200U);  // those with a force
  record("most_sweeps_in_a_step", most);
  record("mean_sweeps_in_a_step", double(sum) / kSteps);
  EXPECT_LE(most, 2 * tolerance::Contact().rowSweeps);
  EXPECT_LT(double(sum) / kSteps, 40);
  EXPECT_TRUE(world_.warnings.empty());
}

/// The floor carries what the blocks weigh, once damping has brought them to rest.
TEST_P(TouchingBlocks, StandOnTheirFloor) {
  build({3});
  // Near the critical damping of the wall's lowest vertical mode, c/4H: it rests soonest.
  const double speed = std::sqrt(30e9 / 2500), height = 3 * kBlockSide;
  world_.dynamicsSettings.damping = 3.14 * speed / height;
  while (world_.time < 20 * height / speed) world_.step(dt_);
  double pushed = 0, weight = 0;
  const Nodes& nodes = world_.model.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes.component[n] == ComponentId(0))
      pushed -= world_.contact.forces()[n].y;
    else
      weight += 9.81 * nodes.mass[n];
  }
  // A ten-thousandth: what is left of the wall's oscillation by then.
  figure("force_on_the_floor_over_weight", pushed / weight, 1, 1e-3);
}

/// A joint that is closed from the start and one that closes in the first steps are the same joint:
/// gravity does the same work until the wall swings back.
TEST_P(TouchingBlocks, TakeTheEnergyOfBlocksAHairApart) {
  build({4});
  World apart;
  apart.contactSettings.passes = GetParam();
  addBlockWall(apart, {4, 1e-10});
  const auto energy = [](const World& world) {
    return world.kineticEnergy() + world.strainEnergy();
  };
  double most = 0, mostApart = 0;
  for (int i = 0; i < 200; ++i) {
    world_.step(dt_), apart.step(dt_);
    most = std::max(most, energy(world_)), mostApart = std::max(mostApart, energy(apart));
  }
  // Joints that open and close lose what their nodes bring; when they do so differs.
  figure("largest_energy_over_that_of_blocks_apart", most / mostApart, 1, .03);
}

INSTANTIATE_TEST_SUITE_P(Passes, TouchingBlocks, testing::Values(1, 2),
                         [](const auto& pass) { return pass.param == 1 ? "One" : "Two"; });

}  // namespace
}  // namespace yadefrag::test
