#pragma once
// Bodies whose nodes differ along their common sides, for the tests of their bonds.

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "step/bodies.hpp"

namespace yadefrag::test {

inline constexpr ElasticMaterial kMaterial{10e9, 0, 1000, true};
inline constexpr double kHeight = .02;  // m
inline const ComponentId kFirst(std::size_t{0}), kSecond(std::size_t{1}), kThird(std::size_t{2});

inline TriangleMesh blockOf(Vec2 low, Vec2 high, double size) {
  const auto parts = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(length / size)));
  };
  return structuredRectangle(low, high, parts(high.x - low.x), parts(high.y - low.y),
                             QuadPattern::kCrossed);
}

inline TriangleMesh barFrom(double begin, double end, int rows) {
  return blockOf({begin, 0}, {end, kHeight}, kHeight / rows);
}

inline BodySpec resting(const TriangleMesh& mesh) { return moving(mesh, kMaterial, {}); }

inline double bondedLength(const World& world) {
  double sum = 0;
  for (const double area : world.fracture.cohesion.area) sum += 2 * area;
  return sum;
}

/// (m/s) At a place along a bar: a pulse of 1 m/s between x = .05 and .15 m.
inline double pulse(double x) {
  return .5 * (1 - std::cos(2 * M_PI * std::clamp((x - .05) / .1, 0., 1.)));
}

/// Bonded bars in which the pulse has run 0.2 m at the speed of sound c, in steps of `dt`.
inline World pulseIn(const std::vector<TriangleMesh>& parts, double dt) {
  World world;
  const double c = std::sqrt(kMaterial.young / kMaterial.density);
  for (const TriangleMesh& mesh : parts) {
    BodySpec spec = resting(mesh);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const double s = std::clamp((mesh.nodes[n].x - .05) / .1, 0., 1.);
      spec.velocity[n].x = pulse(mesh.nodes[n].x);
      const double passed = s - std::sin(2 * M_PI * s) / (2 * M_PI);
      spec.displacement.push_back({.1 / (2 * c) * (1 - passed), 0});
    }
    world.addBody(mesh, spec);
  }
  for (std::size_t i = 1; i < parts.size(); ++i)
    world.bond(ComponentId(i - 1), ComponentId(i), 1e9, 1e6);
  while (world.time < .2 / c) world.step(dt);
  return world;
}

/// A brick on two half bricks that are shifted by `part` of an element, turned by `angle`.
inline World tJunction(double part, double angle, double upperSize, bool isFree = true) {
  constexpr double size = .01;
  World world;
  const double shift = part * size;
  for (const auto& [low, high, own] : {std::tuple{Vec2{0, 0}, Vec2{.06, .04}, size},
                                       {Vec2{.06, 0}, Vec2{.12, .04}, size},
                                       {Vec2{shift, .04}, Vec2{.12 + shift, .08}, upperSize}}) {
    TriangleMesh mesh = blockOf(low, high, own);
    BodySpec spec = resting(mesh);
    spec.friction = .5;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec2 at = mesh.nodes[n];
      if (isFree) spec.velocity[n] = {-3 * at.y, 5 * at.x};
      mesh.nodes[n] = turnedBy(at, angle);
    }
    world.addBody(mesh, spec);
  }
  return world;
}

}  // namespace yadefrag::test
