// Linear and angular momentum of bodies that collide freely: no node is held, no force from
// outside.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {
namespace {

enum class Shape { kSquare, kDisc };

constexpr double kSize = .02;  // m, edge of the square, diameter of the disc

TriangleMesh bodyOf(Shape shape, Vec2 centre, double turn, int around) {
  Polygon polygon;
  const int corners = shape == Shape::kSquare ? 4 : around;
  const double radius = shape == Shape::kSquare ? kSize / std::numbers::sqrt2 : kSize / 2;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    polygon.outline.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return triangulate(polygon, std::numbers::pi * kSize / around);
}

struct Moments {
  Vec2 linear;         // kg m/s
  double angular = 0;  // kg m²/s; x × v is the same with the positions at both ends of the step
};

Moments moments(const World& world) {
  Moments sum;
  const Nodes& nodes = world.model.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sum.linear += nodes.mass[i] * nodes.velocity[i];
    sum.angular += nodes.mass[i] * cross(nodes.position[i], nodes.velocity[i]);
  }
  return sum;
}

struct Case {
  Shape left, right;
  double friction;
  int passes;
  bool face = false;  ///< the squares' faces meet flat, else a corner comes first
};

/// Two bodies meet off their centres; they turn, or slide along each other.
void collide(const Case& c) {
  World world;
  world.contactSettings.passes = c.passes;
  const double quarter = std::numbers::pi / 4, apart = c.face ? .0101 : .0137;
  const TriangleMesh a = bodyOf(c.left, {-apart, 0}, c.face ? quarter : .3, 24);
  const TriangleMesh b = bodyOf(c.right, {apart, .004}, c.face ? quarter : 1.1, 32);
  BodySpec left = moving(a, steel(), {60, 0}), right = moving(b, steel(), {-60, 5});
  const double spin = c.face ? 0 : 800;  // rad/s
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    left.velocity[i] += spin * Vec2{-a.nodes[i].y, a.nodes[i].x + apart};
  left.friction = right.friction = c.friction;
  if (c.left == Shape::kDisc) smoothAll(left, a);
  if (c.right == Shape::kDisc) smoothAll(right, b);
  world.addBody(a, left);
  world.addBody(b, right);

  const double dt = .8 * world.criticalTimeStep();
  const Moments before = moments(world);
  const double scale = mass(world, ComponentId(0)) * 60;
  double impulse = 0, linear = 0, angular = 0;
  int touching = 0;
  for (int i = 0; i < 4000; ++i) {
    world.step(dt);
    Vec2 force;
    for (std::size_t node = 0; node < a.nodes.size(); ++node) force += world.contact.forces()[node];
    touching += static_cast<int>(world.contact.rows().size());
    impulse += norm(force) * dt;
    const Moments now = moments(world);
    linear = std::max(linear, norm(now.linear - before.linear));
    angular = std::max(angular, std::abs(now.angular - before.angular));
  }
  record("rows", touching);
  record("impulse_over_momentum", impulse / scale);
  ASSERT_GT(impulse, .1 * scale);
  figure("linear_over_impulse", linear / impulse, 0, 1e-12);
  figure("angular_over_impulse_length", angular / impulse / kSize, 0, 1e-5);
}

class Momentum : public ::testing::TestWithParam<Case> {};

TEST_P(Momentum, IsKept) { collide(GetParam()); }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [left, right] : {std::pair{Shape::kSquare, Shape::kSquare},
                                    {Shape::kSquare, Shape::kDisc},
                                    {Shape::kDisc, Shape::kDisc}})
    for (const double friction : {0., .3, 1.})
      for (const int passes : {1, 2})
        for (const bool face : {false, true}) all.push_back({left, right, friction, passes, face});
  return all;
}

std::string nameOf(const ::testing::TestParamInfo<Case>& info) {
  const auto shape = [](Shape s) { return s == Shape::kSquare ? "Square" : "Disc"; };
  return std::string(shape(info.param.left)) + shape(info.param.right) + "Friction" +
         std::to_string(std::lround(10 * info.param.friction)) + "Passes" +
         std::to_string(info.param.passes) + (info.param.face ? "Flat" : "");
}

INSTANTIATE_TEST_SUITE_P(Collisions, Momentum, ::testing::ValuesIn(cases()), nameOf);

}  // namespace
}  // namespace yadefrag::test
