// From nanometres to thousands of kilometres, near the origin and far from it, any way round.

#include <gtest/gtest.h>
#include <cmath>

#include "extremes/block_collision.hpp"

namespace yadefrag::test {
namespace {

const BlockCollision kUsual{.aside = .1317};

TEST(ExtremeSize, OutcomeIsTheSameButForRounding) {
  const Outcome usual = collide(kUsual);
  double least = kNone, most = kNone;
  for (const double size : {1e-30, 1e-15, 1e-9, 1e-3, 1e3, 1e6, 1e15, 1e30}) {
    BlockCollision collision = kUsual;
    collision.size = size;
    const Outcome outcome = collide(collision);
    EXPECT_TRUE(outcome.isSound()) << size << ": " << outcome.refusal;
    EXPECT_LE(difference(collision, outcome, kUsual, usual), 1e-13) << size;
    if (std::isnan(least)) least = size;
    most = size;
  }
  for (const double size : {1e-200, 1e-160, 1e155, 1e200}) {
    BlockCollision collision = kUsual;
    collision.size = size;
    EXPECT_NE(collide(collision).refusal, "") << size;
  }
  limit("size of a body, m", least, most, "refused if masses exceed the range of numbers");
}

TEST(ExtremeSize, TurnsChangeRoundingOnly) {
  const Outcome usual = collide(kUsual);
  for (const double turn : {1e-9, .1, 1., 1.5707963267948966, 2., 3., -2.}) {
    BlockCollision collision = kUsual;
    collision.turn = turn;
    EXPECT_LE(difference(collision, collide(collision), kUsual, usual), 1e-13) << turn;
  }
}

/// Rounding grows with the coordinates: 10⁻¹⁶ of them, ten times over the run.
TEST(ExtremeSize, ShiftsChangeRoundingOnly) {
  double most = kNone;
  for (const double size : {1., 1e-3}) {
    BlockCollision near = kUsual;
    near.size = size;
    const Outcome usual = collide(near);
    for (const double ratio : {1e3, 1e6, 1e9, 1e11}) {
      BlockCollision collision = near;
      collision.shift = {ratio * size, -.3 * ratio * size};
      const Outcome outcome = collide(collision);
      EXPECT_TRUE(outcome.isSound()) << size << " " << ratio << ": " << outcome.refusal;
      EXPECT_LE(difference(collision, outcome, near, usual), 1e-14 * ratio) << size << " " << ratio;
      most = ratio;
    }
    BlockCollision collision = near;
    collision.shift = {1e12 * size, 0};
    EXPECT_NE(collide(collision).refusal, "") << size;
  }
  limit("distance from the origin, of a body's size", kNone, most,
        "refused when added: coordinates too coarse for its edges");
}

/// A millimetre block 1000 km from the origin.
TEST(ExtremeSize, SmallBodiesFarFromTheOrigin) {
  double least = kNone;
  for (const double speed : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1., 10.}) {
    BlockCollision near = kUsual;
    near.size = 1e-3, near.speed = speed, near.gap = 1e-5;
    BlockCollision far = near;
    far.shift = {1e6, -1e6};
    const Outcome outcome = collide(far), usual = collide(near);
    if (speed < 1e-3) {
      EXPECT_NE(outcome.refusal.find("lost in rounding"), std::string::npos) << outcome.refusal;
      continue;
    }
    // Rounding adds up to 5 % to the slowest.
    EXPECT_TRUE(outcome.isSound(speed > 1e-3 ? 5e-3 : 5e-2)) << speed << ": " << outcome.refusal;
    EXPECT_NEAR(outcome.left.x, usual.left.x, .01) << speed;
    EXPECT_LE(difference(far, outcome, near, usual), 1e-5) << speed;
    if (std::isnan(least)) least = speed;
  }
  limit("speed of a millimetre block 10⁶ m from the origin, m/s", least, kNone,
        "refused when added: its steps would be lost in rounding, which adds up to 5 % there");
}

}  // namespace
}  // namespace yadefrag::test
