#pragma once
// Outlines, turned points and sums over nodes that tests of all folders share.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "mesh/model.hpp"

namespace yadefrag::test {

using Loop = std::vector<Vec2>;

inline constexpr double kDegree = std::numbers::pi / 180;

/// By an angle (rad) about the origin.
inline Vec2 turnedBy(Vec2 p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y,
          std::sin(angle) * p.x + std::cos(angle) * p.y};
}

inline Loop turnedLoop(Loop loop, double angle) {
  for (Vec2& p : loop) p = turnedBy(p, angle);
  return loop;
}

inline Loop box(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

/// Corners at even angles, the first one at `start` (rad).
inline Loop circle(Vec2 centre, double radius, int corners, double start = 0) {
  Loop loop;
  for (int k = 0; k < corners; ++k) {
    const double angle = start + 2 * std::numbers::pi * k / corners;
    loop.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return loop;
}

struct Moments {
  Vec2 linear;         ///< kg m/s
  double angular = 0;  ///< kg m²/s, about the origin
};

inline Moments momentsOf(const Nodes& nodes) {
  Moments sum;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    sum.linear += nodes.mass[n] * nodes.velocity[n];
    sum.angular += nodes.mass[n] * cross(nodes.position[n], nodes.velocity[n]);
  }
  return sum;
}

/// By places of the stress-free bodies.
inline std::vector<NodeId> nodesWhere(const Nodes& nodes, const std::function<bool(Vec2)>& where) {
  std::vector<NodeId> found;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (where(nodes.reference[n])) found.emplace_back(n);
  return found;
}

}  // namespace yadefrag::test
