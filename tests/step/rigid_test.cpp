// Rigid boundaries: lines and outlines without elements that bodies touch.

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "meshing/structured.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr ElasticMaterial kSoft{1e7, .3, 1000, false};

/// A line from a to b with both sides.
RigidSpec line(Vec2 a, Vec2 b, double friction = 0) {
  RigidSpec spec;
  spec.shape.nodes = {a, b};
  spec.shape.loops = {{0, 1}};
  spec.friction = friction;
  spec.name = "line";
  return spec;
}

BodySpec block(const TriangleMesh& mesh, Vec2 velocity, double friction = 0) {
  BodySpec spec = moving(mesh, kSoft, velocity);
  spec.friction = friction;
  return spec;
}

/// A square of 0.1 m, its lower left corner at `at`, turned by `angle` about that.
TriangleMesh square(Vec2 at, double angle = 0) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {.1, .1}, 4, 4);
  for (Vec2& node : mesh.nodes)
    node = at + Vec2{std::cos(angle) * node.x - std::sin(angle) * node.y,
                     std::sin(angle) * node.x + std::cos(angle) * node.y};
  return mesh;
}

Vec2 meanVelocity(const World& world, ComponentId body) {
  return (1 / mass(world, body)) * test::momentum(world, body);
}

/// The floor as a line, and as a body of two triangles that are held.
World drop(bool asBody, double friction, double angle) {
  World world;
  const TriangleMesh mesh = square({.013, .001}, angle);
  world.addBody(mesh, block(mesh, {.5, -1}, friction));
  if (!asBody) {
    world.addRigid(line({1, 0}, {-1, 0}, friction));
    return world;
  }
  const TriangleMesh floor = structuredRectangle({-1, -1}, {1, 0}, 1, 1);
  BodySpec spec = block(floor, {}, friction);
  hold(spec, floor, kHeldXY, [](Vec2) { return true; });
  world.addBody(floor, spec);
  return world;
}

TEST(Rigid, LineIsAsABodyThatIsHeld) {
  for (const double angle : {0., .3})
    for (const double friction : {0., .4}) {
      World one = drop(false, friction, angle), other = drop(true, friction, angle);
      // Without the floor's triangles, for they would limit the step.
      const double dt = .5 * one.criticalTimeStep();
      ASSERT_LE(dt, other.criticalTimeStep());
      double apart = 0;
      std::size_t touched = 0;
      for (int i = 0; i < 600; ++i) {
        one.step(dt), other.step(dt);
        touched += one.contact.rows().size();
        for (std::size_t n = 0; n < 25; ++n)
          apart =
              std::max(apart, norm(one.model.nodes.position[n] - other.model.nodes.position[n]));
      }
      EXPECT_GT(touched, 50);
      EXPECT_LE(apart, 1e-13);  // the same rows, but for rounding along a line that ends elsewhere
      EXPECT_GT(meanVelocity(one, ComponentId(0)).y, 0);
    }
}

TEST(Rigid, HasNoEnergyNoMassAndNoCriticalStep) {
  World world, alone;
  const TriangleMesh mesh = square({0, .001});
  world.addBody(mesh, block(mesh, {0, -1})), alone.addBody(mesh, block(mesh, {0, -1}));
  world.addRigid(line({.9, 0}, {-.8, 0}));
  EXPECT_EQ(world.criticalTimeStep(), alone.criticalTimeStep());
  EXPECT_EQ(world.kineticEnergy(), alone.kineticEnergy());
  // What the leapfrog's energy changes by where a contact opens or closes.
  const double before = world.kineticEnergy(), dt = .5 * world.criticalTimeStep();
  for (int i = 0; i < 400; ++i) {
    world.rigidVelocities = {{0, .2}, {0, .2}};
    world.step(dt);
  }
  EXPECT_GT(world.ledger.external, .05 * before);  // a floor that comes up works on the block
  EXPECT_NEAR(totalEnergy(world), before, 1e-4 * before);
  EXPECT_NEAR(world.model.nodes.position[world.rigidNodes()[0].value].y, .2 * 400 * dt, 1e-15);
}

TEST(Rigid, BothSidesOfALineTouchAndItsEndsToo) {
  const double half = std::numbers::pi;
  for (const double angle : {0., .4}) {
    // From above, from below, and onto the upper end of an upright line.
    for (const int how : {0, 1, 2}) {
      World world;
      const double sign = how == 1 ? -1 : 1;
      const TriangleMesh mesh = square({0, sign * .001}, how == 1 ? half + angle : angle);
      world.addBody(mesh, block(mesh, {0, -sign}));
      if (how == 2)
        world.addRigid(line({.04, -.5}, {.04, 0}));
      else
        world.addRigid(line({-1, 0}, {1, 0}));
      const double dt = .5 * world.criticalTimeStep();
      double deepest = 0;
      for (int i = 0; i < 600; ++i) {
        world.step(dt);
        deepest = std::max(deepest, world.contact.maxPenetration());
      }
      if (how == 2 && angle != 0) continue;  // it slides off the tip
      EXPECT_GT(sign * meanVelocity(world, ComponentId(0)).y, 0) << how << " " << angle;
      EXPECT_LT(deepest, 2e-7);
    }
  }
}

TEST(Rigid, OverlapIsRefusedAndNothingChanges) {
  World world;
  const TriangleMesh mesh = square({0, 0});
  world.addBody(mesh, block(mesh, {}));
  EXPECT_THROW(world.addRigid(line({-1, .05}, {1, .05})), InputError);
  EXPECT_FALSE(world.hasRigid());
  EXPECT_EQ(world.model.components.size(), 1);
  EXPECT_THROW(world.addRigid(line({.02, -1}, {.03, 1})), InputError);
  world.addRigid(line({-1, 0}, {1, 0}));  // along its lower side
  world.addRigid(line({.1, -1}, {.1, 1}));
  const TriangleMesh below = square({0, -.05});
  EXPECT_THROW(world.addBody(below, block(below, {})), InputError);
  const TriangleMesh beside = square({0, -.1});
  EXPECT_EQ(world.addBody(beside, block(beside, {})).value, 3);
  world.replaceRigid(std::vector{line({-1, 0}, {1, 0})}, std::vector{0U, 1U});
  EXPECT_EQ(world.rigidNodes().size(), 2);
  world.replaceRigid({}, {});
  EXPECT_FALSE(world.hasRigid());
  world.step(.5 * world.criticalTimeStep());
}

// Made anew, a boundary that is the same keeps what touches it.
TEST(Rigid, MadeAnewKeepsWhatTouchesIt) {
  World world = drop(false, .4, 0), other = drop(false, .4, 0);
  const double dt = .5 * world.criticalTimeStep();
  std::size_t touched = 0;
  for (int i = 0; i < 400; ++i) {
    // The other side first, and one far away: other numbers.
    if (i % 3 == 0) {
      const std::vector<std::uint32_t> former =
          other.rigidNodes().size() == 2 ? std::vector{World::kNoCorner, World::kNoCorner, 0U, 1U}
                                         : std::vector{World::kNoCorner, World::kNoCorner, 2U, 3U};
      other.replaceRigid(std::vector{line({1, -9}, {-1, -9}), line({1, 0}, {-1, 0}, .4)}, former);
    }
    touched += other.contact.touches.size();
    world.step(dt), other.step(dt);
    ASSERT_EQ(world.contact.touches.size(), other.contact.touches.size()) << i;
    for (std::size_t n = 0; n < 25; ++n)
      ASSERT_LE(norm(world.model.nodes.position[n] - other.model.nodes.position[n]), 1e-13) << i;
  }
  EXPECT_GT(touched, 100);
  other.replaceRigid({}, {});
  EXPECT_TRUE(other.contact.touches.empty());
  EXPECT_EQ(other.model.components.size(), 1);
}

}  // namespace
}  // namespace yadefrag::test
