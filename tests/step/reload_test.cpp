// Saved at any moment and loaded again, a run goes on with the same bits: whatever does not survive
// shows some steps later.

#include <gtest/gtest.h>

#include <vector>

#include "extremes/limits.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

/// What a step makes anew is there only after one.
TEST(Reload, GoesOnWithTheSameBits) {
  for (const auto& [name, scene] : scenes()) {
    SCOPED_TRACE(name);
    World world = scene();
    const double dt = .3 * world.criticalTimeStep();
    std::vector<World> copies;
    const int steps = longRun() ? 1000 : 250, every = longRun() ? 10 : 40;
    for (int i = 0; i < steps; ++i) {
      if (i % every == 3) copies.push_back(copyOf(world));
      world.step(dt);
      const State state = stateOf(world);
      for (std::size_t k = 0; k < copies.size(); ++k) {
        copies[k].step(dt);
        ASSERT_EQ(whatDiffers(state, stateOf(copies[k])), "") << "step " << i << ", copy " << k;
      }
    }
  }
}

}  // namespace
}  // namespace yadefrag::test
