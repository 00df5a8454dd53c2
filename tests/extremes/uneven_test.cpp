// Segments of very different length on one surface, hit softly and hard.

#include <gtest/gtest.h>

#include "extremes/block_collision.hpp"
#include "extremes/number_text.hpp"
#include "outline/polygon.hpp"

namespace yadefrag::test {
namespace {

/// Segments in the middle of a side are shorter than the others by this factor.
TriangleMesh unevenBlock(double ratio) {
  Polygon polygon;
  const double tiny = .5 / ratio;
  polygon.outline = {{0, 0}, {.5, 0}, {.5 + tiny, 0}, {.5 + 2 * tiny, 0}, {1, 0}, {1, .5}, {0, .5}};
  return triangulate(checkPolygon(polygon), .5);
}

/// It comes down on another block, whose segments are as long as its long ones, at a part of the
/// wave speed, a micrometre away.
struct Down {
  double ratio, speed;
  int passes;
  double ofCritical = .8;
};

TimedResult fall(const Down& down) {
  World world;
  world.contactSettings.passes = down.passes;
  const TriangleMesh uneven = unevenBlock(down.ratio);
  const TriangleMesh other = structuredRectangle({.1, -.5}, {.9, -1e-6}, 3, 2);
  const double speed = down.speed * waveSpeed(rubber());
  world.addBody(uneven, moving(uneven, rubber(), {0, -speed}));
  world.addBody(other, moving(other, rubber(), {}));
  return watchFor(world, 1e-6 / speed + 3 / waveSpeed(rubber()), down.ofCritical);
}

TEST(ExtremeShape, SegmentsOfVeryDifferentLength) {
  double most = kNone;
  for (const double ratio : {1e2, 1e3, 1e4}) {
    if (ratio > 5e3 && !longRun()) continue;
    for (const int passes : {1, 2}) {
      const TimedResult result = fall({ratio, 1e-5, passes});
      EXPECT_EQ(result.refusal, "") << ratio;
      EXPECT_LE(result.deepest, passes == 1 ? 1e-6 : 1e-3 / ratio) << ratio << " " << passes;
      EXPECT_LE(result.growth, 1e-3) << ratio;
      EXPECT_TRUE(result.touched) << ratio;
    }
    most = ratio;
  }
  if (longRun())
    limit("length over length of segments on one surface", kNone, most,
          "not tried; for blows on the short ones see below");
}

/// The fastest collision (of the wave speed) that it stands; a faster one stops with a sentence,
/// and no body is ever deeper in the other than a part of the shortest segment.
double fastestCollision(double ratio, int passes) {
  double most = kNone;
  for (const double speed : {1e-4, 1e-3, .01, .1, 1.}) {
    const TimedResult result = fall({ratio, speed, passes, .5});
    const std::string what = numberText(ratio) + " " + numberText(speed);
    EXPECT_LE(result.deepest, (passes == 1 ? .5 : 4e-3) * .5 / ratio) << what;
    EXPECT_LE(result.growth, 1e-3) << what;
    EXPECT_TRUE(result.touched) << what;
    if (result.refusal.empty()) {
      most = speed;
      continue;
    }
    EXPECT_NE(result.refusal.find("is pressed to"), std::string::npos) << result.refusal;
    break;
  }
  return most;
}

TEST(ExtremeShape, HardBlowsOnShortSegments) {
  EXPECT_EQ(fastestCollision(10, 2),
            .1);  // faster ones need a shorter step than half the critical one
  EXPECT_EQ(fastestCollision(100, 1), .1);
  limit("closing speed onto segments 100 times as short as others, of the wave speed", kNone,
        fastestCollision(100, 2), "refused: an element that collapses needs a shorter step");
  if (!longRun()) return;
  EXPECT_EQ(fastestCollision(1e3, 1), .01);
  EXPECT_EQ(fastestCollision(1e3, 2), .01);
  limit("closing speed onto segments 10⁴ times as short as others, of the wave speed", kNone,
        fastestCollision(1e4, 2), "refused: an element that collapses needs a shorter step");
}

}  // namespace
}  // namespace yadefrag::test
