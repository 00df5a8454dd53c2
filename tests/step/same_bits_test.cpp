// What must not change a run, in every eventful scene: the number of threads, saving and loading at
// any moment, making anew what is not saved, and how often is searched. The bits are the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "core/same_bits.hpp"
#include "extremes/limits.hpp"
#include "step/eventful_scenes.hpp"
#include "step/run_result.hpp"

namespace yadefrag::test {
namespace {

/// A body leaves and another one comes.
void exchangeBodies(World& world) {
  world.removeBody(ComponentId(3));
  const TriangleMesh mesh = structuredRectangle({-1.3, 2}, {-.7, 2.6}, 4, 3);
  world.addBody(mesh, moving(mesh, {1e7, .3, 1000, false}, {12, 0}));
}

class SameBits : public testing::TestWithParam<std::pair<const std::string, Scene>> {};

TEST_P(SameBits, ForAnyThreadsCopiesAndSearches) {
  const ThreadsForFew few;
  // Of the shorter run every second scene has one pass.
  const int alone = 1 + static_cast<int>(GetParam().first.size() % 2);
  for (const int passes : longRun() ? std::vector<int>{1, 2} : std::vector<int>{alone}) {
    SCOPED_TRACE(passes);
    const auto make = [&] {
      World world = GetParam().second();
      world.contactSettings.passes = passes;
      return world;
    };
    World world = make();
    const double dt = .3 * world.criticalTimeStep();
    std::deque<World> whole, motion;  // with the state of `world`; with its motion
    for (const int threads : {2, 3}) whole.emplace_back(make()).threads = threads;
    for (const double halo : {.05, .5}) motion.emplace_back(make()).contactSettings.halo = halo;
    World& rebuilt = motion.emplace_back(make());
    World& searched = motion.emplace_back(make());
    const int steps = longRun() ? 1000 : 150, every = longRun() ? 10 : 60;
    for (int i = 0; i < steps; ++i) {
      if (i == steps / 2 && GetParam().first == "crowd") {
        exchangeBodies(world);
        for (auto* worlds : {&whole, &motion}) std::ranges::for_each(*worlds, exchangeBodies);
      }
      if (i % every == 3) whole.push_back(copyOf(world));
      if (i % 40 == 39) rebuilt.rebuild();
      searched.search.makeDue();
      world.step(dt);
      const State state = stateOf(world);
      for (std::size_t k = 0; k < whole.size(); ++k) {
        whole[k].step(dt);
        ASSERT_EQ(whatDiffers(state, stateOf(whole[k])), "") << "step " << i << ", world " << k;
      }
      for (std::size_t k = 0; k < motion.size(); ++k) {
        motion[k].step(dt);
        ASSERT_TRUE(sameBits(world.model.nodes.position, motion[k].model.nodes.position) &&
                    sameBits(world.model.nodes.velocity, motion[k].model.nodes.velocity))
            << "step " << i << ", world " << k;
        ASSERT_EQ(world.fracture.numCracks(), motion[k].fracture.numCracks());
        ASSERT_EQ(world.ledger.dropped, motion[k].ledger.dropped);
        ASSERT_EQ(world.ledger.contact, motion[k].ledger.contact);
        ASSERT_EQ(world.ledger.friction, motion[k].ledger.friction);
        ASSERT_EQ(activesOf(world), activesOf(motion[k]));
      }
    }
    EXPECT_GE(searched.numSearches(), world.numSearches());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::ValuesIn(scenes()),
                         [](const auto& test) { return test.param.first; });

}  // namespace
}  // namespace yadefrag::test
