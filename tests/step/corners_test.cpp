// Corners: where node against segment has the most ways to go wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/checks.hpp"
#include "fracture/overlaps.hpp"
#include "meshing/polygon.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

/// A node a thousandth of a segment inside is not on the wrong side: a corner that grazes a corner
/// is held where it came in and let out by 2 % a step (lib/contact), and Newton's remainder is
/// smaller.
constexpr double kWrongSide = 1e-3;
/// Kinetic and strain energy may exceed the start's by this much.
constexpr double kGrowth = 5e-3;

TriangleMesh meshOf(std::vector<Vec2> outline, double size) {
  return triangulate(checkPolygon({std::move(outline), {}}), size);
}

void expectSound(const RunResult& result) {
  EXPECT_LE(result.deepest, kWrongSide);
  EXPECT_LE(result.growth, kGrowth);
  EXPECT_LE(result.drift, kGrowth);
  EXPECT_GT(result.touched, 0U);
}

class CornerOnCorner : public testing::TestWithParam<double> {};

/// Blocks one on the other, their lateral faces aligned but for an offset; squares tip to tip.
TEST_P(CornerOnCorner, BlockOnBlockAndTipOnTip) {
  const double off = GetParam();
  World blocks = twoPasses(), tips = twoPasses();
  const Vec2 high{off, 1};
  addMoving(blocks, structuredRectangle({0, 0}, {1, 1}, 6, 6), rubber(), {});
  addMoving(blocks, structuredRectangle(high, high + Vec2{1, 1}, 8, 8), rubber(), {0, -10});
  addMoving(tips, meshOf({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, .2), rubber(), {});
  addMoving(tips, meshOf({{2.05, off - 1}, {3.05, off}, {2.05, off + 1}, {1.05, off}}, .17),
            rubber(), {-10, 0});
  for (World* world : {&blocks, &tips}) expectSound(watch(*world, 2000, 10));
}

INSTANTIATE_TEST_SUITE_P(Offsets, CornerOnCorner,
                         testing::Values(0., 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, .02, -.1, .3));

/// A wedge of 20°, held at its base, hit near its tip from above and from below.
TEST(SharpCorner, IsHitNearItsTip) {
  for (const double x : {.9, .98, 1.02})
    for (const int side : {1, -1}) {
      SCOPED_TRACE(testing::Message() << x << ' ' << side);
      World world = twoPasses();
      const TriangleMesh wedge = meshOf({{0, -.18}, {1, 0}, {0, .18}}, .06);
      BodySpec held = moving(wedge, rubber(), {0, 0});
      hold(held, wedge, kHeldXY, [](Vec2 at) { return at.x < 1e-9; });
      const double y = .5 * side;
      world.addBody(wedge, held);
      addMoving(world, meshOf(box({x - .3, y - .25}, {x + .3, y + .25}), .1), rubber(),
                {0, -5. * side});
      expectSound(watch(world, 6000, 20));
    }
}

/// A blunt tip that falls into a wide notch, in the middle and aside; one of 20° that falls askew
/// into a notch of 37°, which is too narrow for a foot.
TEST(ConcaveCorner, TakesATip) {
  // Half of the opening at 1 m and of the falling tip (m, m), how far the tip leans (rad) and is
  // aside (m), its speed (m/s).
  for (const auto& [half, tipHalf, lean, aside, speed] : {std::tuple{1., .4, 0., 0., 10.},
                                                          {1., .4, 0., 1e-6, 10.},
                                                          {1., .4, 0., .05, 10.},
                                                          {.333, .176, 0., 0., 8.},
                                                          {.333, .176, .05, .005, 8.},
                                                          {.333, .176, -.1, -.01, 8.}}) {
    SCOPED_TRACE(testing::Message() << half << ' ' << aside);
    World world = twoPasses();
    std::vector<Vec2> outline{{-1, -1}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}};
    if (half < 1) outline = {{-1, -1}, {1, -1}, {1, 1}, {half, 1}, {0, 0}, {-half, 1}, {-1, 1}};
    const TriangleMesh notch = meshOf(outline, .15);
    BodySpec held = moving(notch, rubber(), {0, 0});
    hold(held, notch, kHeldXY, [](Vec2 at) { return at.y < -1 + 1e-9; });
    const bool narrow = half < 1;
    const Vec2 low{aside, narrow ? .35 : .3}, back{std::sin(lean), std::cos(lean)};
    const Vec2 top = low + (narrow ? 1 : .6) * back, across = tipHalf * rightOf(back);
    world.addBody(notch, held);
    addMoving(world, meshOf({low, top + across, top - across}, .1), rubber(), {0, -speed});
    expectSound(watch(world, 4000, 20));
  }
}

/// A block with a notch lies on a ridge, of a slope of its own, and rattles from side to side. What
/// contact gives is less than a thousandth of the energy; with the normal of the side that the
/// ridge came from it was 125 % and 26 % of it without friction, here and where notch and ridge
/// fit.
TEST(ShallowNotch, RattlesOnARidgeWithoutEnergyFromNothing) {
  for (const auto& [slope, ridge, friction] :
       {std::tuple(.15, .3, 0.), {.15, .3, .1}, {.1, .1, 0.}, {.1, .1, .3}}) {
    SCOPED_TRACE(testing::Message() << slope << ' ' << friction);
    World world = twoPasses();
    const double low = -.1 * slope;
    const TriangleMesh block = meshOf({{-.1, low}, {0, 0}, {.1, low}, {.1, .1}, {-.1, .1}}, .02);
    const double foot = -.2 * ridge;
    const TriangleMesh roof =
        meshOf({{-.2, foot - .05}, {.2, foot - .05}, {.2, foot}, {0, 0}, {-.2, foot}}, .03);
    BodySpec above = moving(block, rubber(), {}), below = moving(roof, rubber(), {});
    hold(below, roof, kHeldXY, [](Vec2) { return true; });
    above.friction = below.friction = friction;
    world.addBody(block, above);
    world.addBody(roof, below);
    world.dynamicsSettings.gravity = {0, -9.81};
    const double dt = .8 * world.criticalTimeStep();
    double energy = 0, given = 0;
    for (int step = 0; step < 2000; ++step) {
      world.step(dt);
      energy = std::max(energy, world.kineticEnergy() + world.strainEnergy());
      given = std::max(given, -world.ledger.contact);
    }
    EXPECT_LE(given, 1e-3 * energy);
    EXPECT_GT(world.contact.rows().size(), 0U);
  }
}

// --- A shape that breaks what holds for blocks: a splinter whose sides do not oppose what it
// pricks.

/// A needle with a tip of 5° falls on a block.
TEST(Splinter, PricksABlock) {
  for (const double tilt : {0., .03, .3})
    for (const int passes : {1, 2}) {
      SCOPED_TRACE(testing::Message() << tilt << ' ' << passes);
      World world = inPasses(passes);
      const TriangleMesh block = structuredRectangle({0, 0}, {1, .5}, 8, 4);
      BodySpec held = moving(block, rubber(), {0, 0});
      hold(held, block, kHeldXY, [](Vec2 at) { return at.y < 1e-9; });
      const Vec2 tip{.53, .505}, back{std::sin(tilt), std::cos(tilt)};
      const Vec2 aside = .0437 * rightOf(back);
      world.addBody(block, held);
      addMoving(world, meshOf({tip, tip + back + aside, tip + back - aside}, .05), rubber(),
                {0, -2});
      expectSound(watch(world, 3000, 20));
    }
}

// --- Smooth surfaces lie inside the polygon that was drawn: two round bodies meet later than their
// polygons would, by what the README states.

/// Of two equal balls that face each other with a node, halfpoints are the slaves that meet first.
/// They are at the angle π/n, at the radius R cos(π/n): each R sin²(π/n) = h²/4R behind its node.
TEST(SmoothGap, ClosesLaterByTheHalfpointsOfBothBalls) {
  constexpr double kRadius = .5, kGap = .01, kSpeed = 1;
  for (const int sides : {12, 24, 48}) {
    const double side = 2 * kRadius * std::sin(std::numbers::pi / sides);
    World world;
    for (const int k : {0, 1}) {
      const TriangleMesh mesh =
          triangulate({circle({k * (2 * kRadius + kGap), 0}, kRadius, sides), {}}, side);
      BodySpec spec = moving(mesh, rubber(), {k == 0 ? kSpeed : 0, 0});
      spec.selfContact = false;
      smoothAll(spec, mesh);
      world.addBody(mesh, spec);
    }
    const double dt = .2 * world.criticalTimeStep();
    while (world.contact.rows().empty() && world.time < 1) world.step(dt);
    // Found in the step that would end inside.
    EXPECT_NEAR(world.time * kSpeed, kGap + side * side / (2 * kRadius), 2 * dt * kSpeed) << sides;
  }
}

}  // namespace
}  // namespace yadefrag::test
