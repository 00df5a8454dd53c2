// Single and double pass: which sampling points may be slaves of which surface.

#include "contact/pass_rule.hpp"

#include <gtest/gtest.h>
#include <cmath>

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

/// The rule in a scene with one component a body, of which `brittle` may crack.
struct Roles {
  explicit Roles(const SurfaceScene& scene, int passes, std::size_t brittle = ~std::size_t{0})
      : surfaces(scene.surfaces) {
    model.components.resize(scene.components);
    if (brittle < scene.components) model.components[brittle].brittle.tensileStrength = 1;
    rule.update(surfaces, scene.at, {.passes = passes});
  }

  [[nodiscard]] bool mayBeSlave(EntryId slave, EntryId master) const {
    return rule.mayBeSlave(model, surfaces, slave, master);
  }

  void expectAllSlaves() const {
    for (std::size_t s = 0; s < surfaces.entries(); ++s)
      for (std::size_t m = 0; m < surfaces.entries(); ++m)
        EXPECT_TRUE(mayBeSlave(EntryId(s), EntryId(m)));
  }

  const ContactSurfaces& surfaces;
  Model model;
  PassRule rule;
};

TEST(PassRule, DoublePassLetsAllBeSlaves) {
  SurfaceScene scene;
  scene.addBody(squareOf(2));
  scene.addBody(squareOf(5));
  Roles(scene, 2).expectAllSlaves();
}

TEST(PassRule, WithABodyThatCracksAllAreSlaves) {
  SurfaceScene scene;
  scene.addBody(squareOf(2));
  scene.addBody(squareOf(5));
  for (const std::size_t brittle : {0U, 1U}) Roles(scene, 1, brittle).expectAllSlaves();
}

TEST(PassRule, FinerSurfaceAndSharpCornersOfTheCoarser) {
  SurfaceScene scene;
  const EntryId coarse = scene.addBody(squareOf(3));
  const EntryId fine = scene.addBody(squareOf(5));
  const Roles roles(scene, 1);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(roles.mayBeSlave(fine + k, coarse));
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(roles.mayBeSlave(coarse + k, fine), k % 3 == 0) << k;
    EXPECT_TRUE(roles.mayBeSlave(coarse + k, coarse))
        << "within one surface every point is a slave";
  }
}

TEST(PassRule, OfEqualSurfacesOneIsTheSlave) {
  SurfaceScene scene;
  scene.addBody(squareOf(6));
  scene.addBody(squareOf(6, {1, 0}));
  const Roles roles(scene, 1);
  const EntryId flat[] = {EntryId(std::size_t{1}), EntryId(std::size_t{25})};
  EXPECT_FALSE(roles.mayBeSlave(flat[0], flat[1]));
  EXPECT_TRUE(roles.mayBeSlave(flat[1], flat[0]));
}

/// Exactly one of two flat points of different surfaces is a slave of the other's.
TEST(PassRule, EachPairHasExactlyOneSlave) {
  Random random(9);
  SurfaceScene scene;
  EntryId flat[8];
  for (EntryId& entry : flat)
    entry = scene.addBody(squareOf(2 + static_cast<int>(random() % 9))) + 1;
  const Roles roles(scene, 1);
  for (std::uint32_t a = 0; a < 8; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      EXPECT_NE(roles.mayBeSlave(flat[a], flat[b]), roles.mayBeSlave(flat[b], flat[a]));
}

TEST(PassRule, SharpMeansConvexAndMoreThanTwentyDegrees) {
  const auto isSlave = [](double degrees) {
    SurfaceScene scene;
    const double turn = degrees * std::numbers::pi / 180;
    // The corner at the origin turns by `turn`, all other corners of the loop are sharp.
    const Vec2 leave{std::cos(turn), std::sin(turn)};
    scene.addBody({{0, 0}, leave, leave + Vec2{-.5, 3}, {-1, 3}, {-1, 0}});
    const EntryId fine = scene.addBody(squareOf(20));
    return Roles(scene, 1).mayBeSlave(EntryId(std::size_t{0}), fine);
  };
  EXPECT_FALSE(isSlave(0));
  EXPECT_FALSE(isSlave(19));
  EXPECT_TRUE(isSlave(21));
  EXPECT_TRUE(isSlave(60));
  EXPECT_FALSE(isSlave(-60)) << "concave corners cannot hit anything";
}

TEST(PassRule, HalfpointsAreNeverSharp) {
  SurfaceScene scene;
  const EntryId body = scene.addBody({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {1, 1, 1, 0});
  const EntryId fine = scene.addBody(squareOf(20));
  const Roles roles(scene, 1);
  for (std::size_t e = body.value; scene.surfaces.loop[e] == 0; ++e) {
    const bool isCorner = scene.surfaces.slave(EntryId(e)).count == 1;
    EXPECT_EQ(roles.mayBeSlave(EntryId(e), fine), isCorner);
  }
}

TEST(PassRule, NothingAtAll) {
  const SurfaceScene none;
  Roles(none, 1).expectAllSlaves();
  Roles(none, 2).expectAllSlaves();
}

}  // namespace
}  // namespace yadefrag::test
