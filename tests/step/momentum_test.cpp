// Linear and angular momentum of bodies that collide freely: no node is held, no force from
// outside.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/checks.hpp"
#include "core/errors.hpp"
#include "meshing/triangulate.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

enum class Shape { kSquare, kDisc };

constexpr double kSize = .02;  // m, edge of the square, diameter of the disc

struct Half {
  Shape shape;
  double turn;  ///< rad
  int around;   ///< edges of a circumference of π kSize
  Vec2 centre, velocity;
  double spin;  ///< rad/s
};

struct Collision {
  Half left, right;
  double friction;
  int passes;
  double young = 210e9;  ///< Pa
};

/// The largest errors of a run.
struct Errors {
  double impulse = 0;  ///< N s, Σ of the contact force on the left one
  double linear = 0;   ///< over the impulse
  double angular = 0;  ///< over impulse × kSize
  double growth = 0;   ///< of kinetic and strain energy, over that at the start
};

TriangleMesh meshOf(const Half& half) {
  const bool square = half.shape == Shape::kSquare;
  const Polygon polygon{circle(half.centre, square ? kSize / std::numbers::sqrt2 : kSize / 2,
                               square ? 4 : half.around, half.turn),
                        {}};
  return triangulate(polygon, std::numbers::pi * kSize / half.around);
}

void add(World& world, const Half& half, const Collision& c) {
  const TriangleMesh mesh = meshOf(half);
  ElasticMaterial material = steel();
  material.young = c.young;
  BodySpec spec = moving(mesh, material, half.velocity);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec2 arm = mesh.nodes[i] - half.centre;
    spec.velocity[i] += half.spin * Vec2{-arm.y, arm.x};
  }
  spec.friction = c.friction;
  if (half.shape == Shape::kDisc) smoothAll(spec, mesh);
  world.addBody(mesh, spec);
}

/// Until both have moved by their size.
Errors collide(const Collision& c) {
  World world = inPasses(c.passes);
  add(world, c.left, c);
  add(world, c.right, c);
  const double dt = .8 * world.criticalTimeStep(), until = kSize / norm(c.left.velocity);
  const Moments before = momentsOf(world.model.nodes);
  const double energy = totalEnergy(world);
  Errors worst;
  while (world.time < until) {
    world.step(dt);
    worst.impulse += norm(contactForce(world, ComponentId(0))) * dt;
    const Moments now = momentsOf(world.model.nodes);
    worst.linear = std::max(worst.linear, norm(now.linear - before.linear));
    worst.angular = std::max(worst.angular, std::abs(now.angular - before.angular));
    worst.growth =
        std::max(worst.growth, (world.kineticEnergy() + world.strainEnergy()) / energy - 1);
  }
  if (worst.impulse > 0) {
    worst.linear /= worst.impulse;
    worst.angular /= worst.impulse * kSize;
  }
  return worst;
}

/// Shapes, friction, passes; squares' faces meet flat and slide along each other, or corners meet,
/// turning.
using Case = std::tuple<std::pair<Shape, Shape>, double, int, bool>;
class Momentum : public ::testing::TestWithParam<Case> {};

TEST_P(Momentum, IsKept) {
  const auto [shapes, friction, passes, face] = GetParam();
  const double quarter = std::numbers::pi / 4, apart = face ? .0101 : .0137;
  const Errors worst = collide(
      {.left = {shapes.first, face ? quarter : .3, 24, {-apart, 0}, {60, 0}, face ? 0. : 800.},
       .right = {shapes.second, face ? quarter : 1.1, 32, {apart, .004}, {-60, 5}, 0},
       .friction = friction,
       .passes = passes});
  record("impulse_in_N_s", worst.impulse);
  ASSERT_GT(worst.impulse, 100);
  figure("linear_over_impulse", worst.linear, 0, 1e-12);
  figure("angular_over_impulse_length", worst.angular, 0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Collisions, Momentum,
                         testing::Combine(testing::Values(std::pair{Shape::kSquare, Shape::kSquare},
                                                          std::pair{Shape::kSquare, Shape::kDisc},
                                                          std::pair{Shape::kDisc, Shape::kDisc}),
                                          testing::Values(0., .3, 1.), testing::Values(1, 2),
                                          testing::Bool()));

Collision anyCollision(std::mt19937& random, bool hasFriction) {
  const auto from = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto is = [&](double chance) { return from(0, 1) < chance; };
  const auto half = [&](Vec2 centre, Vec2 velocity) {
    Half any;
    any.shape = is(.5) ? Shape::kSquare : Shape::kDisc;
    any.turn = from(0, 6);
    any.around = static_cast<int>(from(12, 40));
    any.centre = centre, any.velocity = velocity;
    any.spin = from(-20, 20) * norm(velocity);
    return any;
  };
  const double young = is(.5) ? 210e9 : 4e9;
  const double speed = from(30, 90) * std::sqrt(young / 210e9);
  return {.left = half({-.0143, 0}, {speed, 0}),
          .right = half({.0143, from(-.012, .012)}, {-speed, 0}),
          .friction = hasFriction ? from(0, 1) : 0,
          .passes = is(.5) ? 1 : 2,
          .young = young};
}

/// Any contact, on coarse meshes too.
void anyCollisions(bool hasFriction, double angular) {
  constexpr int count = 80;
  std::mt19937 random{1};
  Errors worst;
  int above = 0, met = 0;
  for (int i = 0; i < count; ++i) {
    const Errors now = collide(anyCollision(random, hasFriction));
    met += now.impulse > 0 ? 1 : 0;
    above += now.angular > 1e-5 ? 1 : 0;
    worst.linear = std::max(worst.linear, now.linear);
    worst.angular = std::max(worst.angular, now.angular);
    worst.growth = std::max(worst.growth, now.growth);
  }
  record("collisions", met);
  record("above_1e-5", above);
  EXPECT_GT(met, count / 2);
  figure("linear_over_impulse", worst.linear, 0, 1e-12);
  figure("angular_over_impulse_length", worst.angular, 0, angular);
  figure("energy_growth", worst.growth, 0, .005);
}

// A slave in the blunt concave joint of a dent, without a foot on either side, has its force at the
// joint's node, not opposite to it.
TEST(MomentumOfAny, CollisionWithoutFriction) { anyCollisions(false, 2e-5); }
// In the step in which two surfaces meet, friction acts across the gap that was left.
TEST(MomentumOfAny, CollisionWithFriction) { anyCollisions(true, 1e-4); }

// --- Rigid boundaries: lines and outlines without elements that bodies touch.

constexpr ElasticMaterial kSoft{1e7, .3, 1000, false};

BodySpec block(const TriangleMesh& mesh, Vec2 velocity, double friction = 0) {
  BodySpec spec = moving(mesh, kSoft, velocity);
  spec.friction = friction;
  return spec;
}

/// A square of 0.1 m, its lower left corner at `at`, turned by `angle` about that.
TriangleMesh square(Vec2 at, double angle = 0) {
  TriangleMesh mesh = structuredRectangle({0, 0}, {.1, .1}, 4, 4);
  for (Vec2& node : mesh.nodes) node = at + turnedBy(node, angle);
  return mesh;
}

/// The floor as a line, and as a body of two triangles that are held.
World drop(bool asBody, double friction, double angle) {
  World world;
  const TriangleMesh mesh = square({.013, .001}, angle);
  world.addBody(mesh, block(mesh, {.5, -1}, friction));
  if (!asBody) {
    world.addRigid(rigidLine({1, 0}, {-1, 0}, friction));
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
  world.addRigid(rigidLine({.9, 0}, {-.8, 0}));
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
        world.addRigid(rigidLine({.04, -.5}, {.04, 0}));
      else
        world.addRigid(rigidLine({-1, 0}, {1, 0}));
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
  EXPECT_THROW(world.addRigid(rigidLine({-1, .05}, {1, .05})), InputError);
  EXPECT_FALSE(world.hasRigid());
  EXPECT_EQ(world.model.components.size(), 1);
  EXPECT_THROW(world.addRigid(rigidLine({.02, -1}, {.03, 1})), InputError);
  world.addRigid(rigidLine({-1, 0}, {1, 0}));  // along its lower side
  world.addRigid(rigidLine({.1, -1}, {.1, 1}));
  const TriangleMesh below = square({0, -.05});
  EXPECT_THROW(world.addBody(below, block(below, {})), InputError);
  const TriangleMesh beside = square({0, -.1});
  EXPECT_EQ(world.addBody(beside, block(beside, {})).value, 3);
  world.replaceRigid(std::vector{rigidLine({-1, 0}, {1, 0})}, std::vector{0U, 1U});
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
      other.replaceRigid(std::vector{rigidLine({1, -9}, {-1, -9}), rigidLine({1, 0}, {-1, 0}, .4)},
                         former);
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
