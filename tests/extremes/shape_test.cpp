// Slivers, nodes at the same place, bodies that touch or overlap at the start.

#include <gtest/gtest.h>
#include <cmath>

#include <numbers>

#include "extremes/block_collision.hpp"
#include "meshing/polygon.hpp"

namespace yadefrag::test {
namespace {

/// A needle of this angle (°), one triangle of 1 m, held at its base.
TriangleMesh needle(double degrees) {
  const double half = std::tan(degrees * std::numbers::pi / 360);
  return oneTriangle({0, -half}, {1, 0}, {0, half});
}

/// A block comes onto a needle's tip (`side` 0), or onto its flank near the tip.
TimedResult hitNeedle(double degrees, int side) {
  World world = twoPasses();
  const TriangleMesh thin = needle(degrees);
  BodySpec held = moving(thin, rubber(), {});
  hold(held, thin, kHeldXY, [](Vec2 at) { return at.x < .5; });
  world.addBody(thin, held);
  const double half = thin.nodes[2].y;
  const Vec2 low = side == 0 ? Vec2{1 + .1 * half, -.23} : Vec2{.7, .4 * half};
  const double speed = .1 * half * waveSpeed(rubber());
  addMoving(world, structuredRectangle(low, low + Vec2{.5, .5}, 2, 2), rubber(),
            side == 0 ? Vec2{-speed, 0} : Vec2{0, -speed});
  return watchFor(world, half / speed);
}

TEST(ExtremeShape, Slivers) {
  double least = kNone;
  for (const double degrees : {10., 1., .1, .01}) {
    if (degrees < .05 && !longRun()) continue;
    for (const int side : {0, 1}) {
      const TimedResult result = hitNeedle(degrees, side);
      const double thickness = 2 * needle(degrees).nodes[2].y;
      EXPECT_EQ(result.refusal, "") << degrees << " side " << side;
      EXPECT_LE(result.deepest, .05 * thickness) << degrees << " side " << side;
      EXPECT_LE(result.growth, 1e-3) << degrees << " side " << side;
      EXPECT_TRUE(result.touched) << degrees << " side " << side;
    }
    if (degrees >= .05) least = degrees;
  }
  limit("angle of a sliver that is hit, °", least, kNone,
        "works, in ever shorter steps, down to 0.01 at least");
}

/// Blocks whose meshes match node by node, four at one point.
TEST(ExtremeShape, CoincidentNodesOfDifferentBodies) {
  for (const int passes : {1, 2})
    for (const double shift : {0., 1e6}) {
      World world = inPasses(passes);
      for (const Vec2 low : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}}) {
        TriangleMesh mesh = structuredRectangle(low, low + Vec2{1, 1}, 4, 4);
        for (Vec2& node : mesh.nodes) node += Vec2{shift, shift};
        addMoving(world, mesh, rubber(), 2 * (Vec2{.5, .5} - low));
      }
      const TimedResult result = watchFor(world, .04);
      EXPECT_EQ(result.refusal, "");
      EXPECT_LE(result.deepest, 1e-5);
      EXPECT_LE(result.growth, 1e-3);
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec2 end = meanVelocity(world, ComponentId(c));
        const Vec2 out{c % 2 == 0 ? -1. : 1., c < 2 ? -1. : 1.};
        EXPECT_GT(end.x * out.x, .5) << c << ": thrown back";
        EXPECT_GT(end.y * out.y, .5) << c;
      }
    }
}

/// Two blocks at rest, touching: they stay, turned or far away, and are kept apart when pushed.
TEST(ExtremeShape, BodiesThatTouchExactly) {
  for (const double turn : {0., .3, 1.})
    for (const double far : {0., 1e6})
      for (const double speed : {0., 1.}) {
        BlockCollision collision{.speed = speed, .gap = 0, .turn = turn, .shift = {far, -far}};
        World world = worldOf(collision);
        const TimedResult result = watchFor(world, .05);
        EXPECT_EQ(result.refusal, "") << turn << " " << far << " " << speed;
        // What a solution may leave at this speed; it is corrected in the next steps.
        EXPECT_LE(result.deepest, speed > 0 ? 3e-5 : 1e-8) << turn << " " << far << " " << speed;
        const Vec2 left = turnedBy(meanVelocity(world, ComponentId(0UL)), -turn);
        if (speed > 0) {
          EXPECT_LT(left.x, .2) << turn << " " << far;
        } else {
          EXPECT_LE(norm(left), far > 0 ? 1e-6 : 1e-13) << turn << " " << far;
        }
      }
}

/// Whatever way they overlap: aligned, crossing without a node inside the other, one in the other.
TEST(ExtremeShape, BodiesThatOverlapAreRefused) {
  const auto refusal = [](const TriangleMesh& a, const TriangleMesh& b) {
    World world;
    addMoving(world, a, rubber(), {});
    const std::size_t nodes = world.model.nodes.size(), entries = world.surfaces.entries();
    std::string text = sentenceOf([&] { addMoving(world, b, rubber(), {}); });
    if (!text.empty()) {
      EXPECT_TRUE(contains(text, "The new body overlaps body 0 at ("));
      EXPECT_EQ(world.model.components.size(), 1U);
      EXPECT_EQ(world.model.nodes.size(), nodes);
      EXPECT_EQ(world.surfaces.entries(), entries);
    }
    world.step(.5 * world.criticalTimeStep());
    return text;
  };
  const TriangleMesh block = structuredRectangle({0, 0}, {1, 1}, 4, 4);
  double most = kNone;
  for (const double depth : {0., 1e-12, 5e-11, 2e-10, 1e-9, 1e-6, 1e-3, .1, .5, 1.})
    for (const double aside : {0., .13}) {
      const Vec2 low{1 - depth, aside};
      const bool fine = refusal(block, structuredRectangle(low, low + Vec2{1, 1}, 5, 5)).empty();
      EXPECT_EQ(fine, depth < 1e-10) << depth << " " << aside;
      if (fine) most = depth * 5;
    }
  EXPECT_NE(refusal(structuredRectangle({0, .4}, {1, .6}, 1, 1),
                    structuredRectangle({.4, 0}, {.6, 1}, 1, 1)),
            "");
  // One body around the other: the depth is that below the sides of the outer one, .44 m, exact up
  // to the shortest side, .03 m.
  const TriangleMesh inside = structuredRectangle({.41, .41}, {.44, .44}, 1, 1);
  for (const std::string& text : {refusal(block, inside), refusal(inside, block)}) {
    const std::size_t at = text.find(" m by ");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(at + 6)), .44, .03 + 1e-9) << text;
  }
  limit(
      "overlap of two bodies at the start, of a segment", kNone, most,
      "up to 0.05 of `size` removed, else refused when added, with the other body, the place, the "
      "amount and a remedy");
}

/// Bodies are where they are now, not where they were; those that went are no matter.
TEST(ExtremeShape, OverlapOfABodyThatIsAddedLater) {
  World world = worldOf({});
  const double dt = .5 * world.criticalTimeStep();
  const auto add = [&](double x) {
    const TriangleMesh other = structuredRectangle({x, .3}, {x + .01, .31}, 1, 1);
    return sentenceOf([&] { addMoving(world, other, rubber(), {}); });
  };
  for (int i = 0; i < 20; ++i) world.step(dt);
  const double left = world.model.nodes.position[0].x;
  EXPECT_GT(left, -1.001);
  EXPECT_TRUE(contains(add(.5), "overlaps body 1 at (0.5"));
  EXPECT_TRUE(contains(add(left + .001), "overlaps body 0 at ("));
  EXPECT_EQ(add(left - .02), "");
  EXPECT_EQ(world.model.components.size(), 3U);
  world.removeBody(ComponentId(1UL));
  EXPECT_EQ(add(.5), "");
  EXPECT_TRUE(contains(add(.502), "overlaps body 3 at ("));
  world.step(.01 * dt);
  EXPECT_EQ(world.steps, 21U);
}

/// Walls may overlap one another, for what is held altogether does not move.
TEST(ExtremeShape, BodiesThatAreHeldMayOverlap) {
  for (const bool secondIsHeld : {true, false}) {
    World world;
    const TriangleMesh first = structuredRectangle({0, 0}, {1, .2}, 4, 1);
    const TriangleMesh second = structuredRectangle({0, .1}, {.2, 1}, 1, 4);
    BodySpec held = moving(first, rubber(), {}), other = moving(second, rubber(), {});
    hold(held, first, kHeldXY, [](Vec2) { return true; });
    if (secondIsHeld) hold(other, second, kHeldXY, [](Vec2) { return true; });
    world.addBody(first, held);
    EXPECT_EQ(sentenceOf([&] { world.addBody(second, other); }).empty(), secondIsHeld);
  }
}

/// The displacement at the start counts, and the boxes of bodies that lie around it do not.
TEST(ExtremeShape, OverlapByDisplacementAndInTheHoleOfARing) {
  World world;
  const Polygon ring{box({0, 0}, {3, 3}), {box({1, 1}, {2, 2})}};
  addMoving(world, triangulate(checkPolygon(ring), .5), rubber(), {});
  const TriangleMesh inner = structuredRectangle({1.2, 1.2}, {1.8, 1.8}, 2, 2);
  BodySpec spec = moving(inner, rubber(), {});
  spec.displacement.assign(inner.nodes.size(), {.3, 0});
  EXPECT_NE(sentenceOf([&] { world.addBody(inner, spec); }), "");
  spec.displacement.assign(inner.nodes.size(), {.2, 0});
  EXPECT_EQ(sentenceOf([&] { world.addBody(inner, spec); }), "");
}

}  // namespace
}  // namespace yadefrag::test
