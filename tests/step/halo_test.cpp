// The width of the halo decides how often is searched, and nothing else.

#include <gtest/gtest.h>

#include "core/same_bits.hpp"
#include "step/eventful_scenes.hpp"

namespace yadefrag::test {
namespace {

class Halo : public testing::TestWithParam<int> {};

TEST_P(Halo, ChangesNoResult) {
  for (const auto& [name, scene] : scenes()) {
    SCOPED_TRACE(name);
    World world = scene();
    world.contactSettings.passes = GetParam();
    const double dt = .3 * world.criticalTimeStep();
    std::vector<World> others;
    for (const double halo : {.05, .2, .5}) {
      World& other = others.emplace_back(scene());
      other.contactSettings.passes = GetParam();
      other.contactSettings.halo = halo;
    }
    for (int i = 0; i < 250; ++i) {
      world.step(dt);
      bool same = true;
      for (World& other : others) {
        other.step(dt);
        same = same && sameBits(world.model.nodes.position, other.model.nodes.position) &&
               sameBits(world.model.nodes.velocity, other.model.nodes.velocity);
        EXPECT_TRUE(same) << "halo " << other.contactSettings.halo << ", step " << i;
      }
      if (!same) break;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Passes, Halo, testing::Values(1, 2));

}  // namespace
}  // namespace yadefrag::test
