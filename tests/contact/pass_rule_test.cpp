// Single and double pass: which sampling points may be slaves of which surface.

#include "contact/pass_rule.hpp"

#include <gtest/gtest.h>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

/// A square of edge 1 with `parts` segments an edge; every `parts`-th node is a corner.
std::vector<Vec2> squareOf(int parts, Vec2 low = {}) {
  std::vector<Vec2> points;
  const Vec2 corner[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < parts; ++k)
      points.push_back(low + corner[side] +
                       double(k) / parts * (corner[(side + 1) % 4] - corner[side]));
  return points;
}

TEST(PassRule, DoublePassLetsAllBeSlaves) {
  SurfaceScene scene;
  scene.addBody(squareOf(2));
  scene.addBody(squareOf(5));
  PassRule rule;
  rule.update(scene.surfaces, scene.at, 2);
  for (std::size_t e = 0; e < scene.surfaces.entries(); ++e)
    for (const std::uint32_t loop : {0U, 1U})
      EXPECT_TRUE(rule.mayBeSlave(EntryId(e), scene.surfaces.loop[e], loop));
}

TEST(PassRule, FinerSurfaceAndSharpCornersOfTheCoarser) {
  SurfaceScene scene;
  const EntryId coarse = scene.addBody(squareOf(3));
  const EntryId fine = scene.addBody(squareOf(5));
  PassRule rule;
  rule.update(scene.surfaces, scene.at, 1);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(rule.mayBeSlave(fine + k, 1, 0));
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(rule.mayBeSlave(coarse + k, 0, 1), k % 3 == 0) << k;
    EXPECT_TRUE(rule.mayBeSlave(coarse + k, 0, 0)) << "within one surface every point is a slave";
  }
}

TEST(PassRule, OfEqualSurfacesOneIsTheSlaveAndStaysIt) {
  Random random(3);
  SurfaceScene scene;
  scene.addBody(squareOf(6));
  scene.addBody(squareOf(6, {1, 0}));
  for (int turn = 0; turn < 50; ++turn) {
    PassRule rule;
    rule.update(scene.surfaces, scene.at, 1);
    const EntryId flat[] = {EntryId(std::size_t{1}), EntryId(std::size_t{25})};
    EXPECT_FALSE(rule.mayBeSlave(flat[0], 0, 1));
    EXPECT_TRUE(rule.mayBeSlave(flat[1], 1, 0));
    // Deformation by some thousandths.
    for (Vec2& point : scene.at)
      point += Vec2{even(random, -4e-4, 4e-4), even(random, -4e-4, 4e-4)};
  }
}

/// Exactly one of two flat points of different surfaces is a slave of the other's.
TEST(PassRule, EachPairHasExactlyOneSlave) {
  Random random(9);
  SurfaceScene scene;
  EntryId flat[8];
  for (EntryId& entry : flat)
    entry = scene.addBody(squareOf(2 + static_cast<int>(random() % 9))) + 1;
  PassRule rule;
  rule.update(scene.surfaces, scene.at, 1);
  for (std::uint32_t a = 0; a < 8; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      EXPECT_NE(rule.mayBeSlave(flat[a], a, b), rule.mayBeSlave(flat[b], b, a));
}

TEST(PassRule, SharpMeansConvexAndMoreThanThirtyDegrees) {
  const auto isSlave = [](double degrees) {
    SurfaceScene scene;
    const double turn = degrees * std::numbers::pi / 180;
    // The corner at the origin turns by `turn`, all other corners of the loop are sharp.
    const Vec2 leave{std::cos(turn), std::sin(turn)};
    scene.addBody({{0, 0}, leave, leave + Vec2{-.5, 3}, {-1, 3}, {-1, 0}});
    scene.addBody(squareOf(20));
    PassRule rule;
    rule.update(scene.surfaces, scene.at, 1);
    return rule.mayBeSlave(EntryId(std::size_t{0}), 0, 1);
  };
  EXPECT_FALSE(isSlave(0));
  EXPECT_FALSE(isSlave(29));
  EXPECT_TRUE(isSlave(31));
  EXPECT_TRUE(isSlave(60));
  EXPECT_FALSE(isSlave(-60)) << "concave corners cannot hit anything";
}

TEST(PassRule, HalfpointsAreNeverSharp) {
  SurfaceScene scene;
  const EntryId body = scene.addBody({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {1, 1, 1, 0});
  scene.addBody(squareOf(20));
  PassRule rule;
  rule.update(scene.surfaces, scene.at, 1);
  for (std::size_t e = body.value; scene.surfaces.loop[e] == 0; ++e) {
    const bool isCorner = scene.surfaces.slave(EntryId(e)).count == 1;
    EXPECT_EQ(rule.mayBeSlave(EntryId(e), 0, 1), isCorner);
  }
}

TEST(PassRule, NothingAtAll) {
  const ContactSurfaces none;
  PassRule rule;
  rule.update(none, {}, 1);
  rule.update(none, {}, 2);
}

}  // namespace
}  // namespace yadefrag::test
