// Shapes that break what holds for blocks: a splinter whose sides do not oppose what it pricks, a
// notch too narrow for a foot.

#include <gtest/gtest.h>
#include <cmath>

#include "outline/polygon.hpp"
#include "step/run_result.hpp"

namespace yadefrag::test {
namespace {

TriangleMesh meshOf(std::vector<Vec2> outline, double size) {
  return triangulate(checkPolygon({std::move(outline), {}}), size);
}

void expectSound(const RunResult& result) {
  EXPECT_LE(result.deepest, 1e-3);
  EXPECT_LE(result.growth, 5e-3);
  EXPECT_LE(result.drift, 5e-3);
  EXPECT_GT(result.touched, 0U);
}

class Splinter : public testing::TestWithParam<std::tuple<double, int>> {};

/// A needle with a tip of 5° falls on a block.
TEST_P(Splinter, PricksABlock) {
  const auto [tilt, passes] = GetParam();
  World world;
  world.contactSettings.passes = passes;
  const TriangleMesh block = structuredRectangle({0, 0}, {1, .5}, 8, 4);
  BodySpec held = moving(block, rubber(), {0, 0});
  hold(held, block, kHeldXY, [](Vec2 at) { return at.y < 1e-9; });
  const Vec2 tip{.53, .505}, back{std::sin(tilt), std::cos(tilt)};
  const Vec2 aside = .0437 * rightOf(back);
  const TriangleMesh needle = meshOf({tip, tip + back + aside, tip + back - aside}, .05);
  world.addBody(block, held);
  world.addBody(needle, moving(needle, rubber(), {0, -2}));
  expectSound(watch(world, 3000, 20));
}

INSTANTIATE_TEST_SUITE_P(TiltsAndPasses, Splinter,
                         testing::Combine(testing::Values(0., .03, .3), testing::Values(1, 2)));

class NarrowNotch : public testing::TestWithParam<double> {};

/// A tip of 20° that falls askew into a notch of 37°.
TEST_P(NarrowNotch, TakesATip) {
  const double lean = GetParam();
  World world;
  world.contactSettings.passes = 2;
  const TriangleMesh notch =
      meshOf({{-1, -1}, {1, -1}, {1, 1}, {.333, 1}, {0, 0}, {-.333, 1}, {-1, 1}}, .15);
  BodySpec held = moving(notch, rubber(), {0, 0});
  hold(held, notch, kHeldXY, [](Vec2 at) { return at.y < -1 + 1e-9; });
  const Vec2 tip{.1 * lean, .35}, back{std::sin(lean), std::cos(lean)};
  const Vec2 aside = .176 * rightOf(back);
  const TriangleMesh wedge = meshOf({tip, tip + back + aside, tip + back - aside}, .1);
  world.addBody(notch, held);
  world.addBody(wedge, moving(wedge, rubber(), {0, -8}));
  expectSound(watch(world, 4000, 20));
}

INSTANTIATE_TEST_SUITE_P(Leans, NarrowNotch, testing::Values(0., .05, -.1));

}  // namespace
}  // namespace yadefrag::test
