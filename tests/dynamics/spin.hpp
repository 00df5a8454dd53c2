#pragma once
// A body that spins freely: the test of elements of every kind.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/blocks.hpp"
#include "dynamics/element_state.hpp"

namespace yadefrag {

/// Turns the model's nodes around the origin (rad/s) for `stepsOf(Δt)` steps: it
/// keeps its energy and shows no stress but that of its spin.
template <class Steps>
void expectNoFalseStressIn(Model model, double spin, Steps stepsOf) {
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    model.nodes.velocity[n] = -spin * rightOf(model.nodes.position[n]);
  Stepper run = runOf(std::move(model), .8);
  const double energy = run.total();
  const int steps = stepsOf(run.dt);
  double largest = 0;
  for (int i = 0; i < steps; i += 100) {
    run.step(100);
    // 10⁻⁵: in one step the block turns by ωΔt = 2·10⁻³, whose square is the leapfrog's error.
    ASSERT_NEAR(run.total(), energy, 1e-5 * energy);
    for (const auto& s : stresses(run.model))
      largest = std::max({largest, std::abs(s[0]), std::abs(s[1]), std::abs(s[2])});
  }
  // Released without the stress of its spin, ρω²R²/2 at most for a disc around it, a body swings to
  // twice that; nothing else may add up.
  EXPECT_LT(largest, 2 * kSteel.density * spin * spin * .0002 / 2);
  EXPECT_GT(largest, 0);
}

}  // namespace yadefrag
