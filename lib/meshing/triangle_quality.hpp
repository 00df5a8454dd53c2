#pragma once
// Measures of triangle shape.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/vec2.hpp"

namespace yadefrag {

/// m², positive if counter-clockwise.
[[nodiscard]] inline double areaOf(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a) / 2; }

/// Tangent of the smallest angle of a triangle, which is opposite to the shortest side; negative if
/// clockwise. It increases with the angle, and is computed without an inverse trigonometric
/// function.
[[nodiscard]] inline double tanMinAngle(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, v = c - b, w = a - c;
  const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const double least = std::min({uu, vv, ww});
  // The other two sides enclose the smallest angle: their dot product is half of this sum.
  return 2 * cross(u, v) / (uu + vv + ww - 2 * least);
}

/// rad, smallest angle of all triangles; 0 if there are none.
[[nodiscard]] inline double minAngle(std::span<const Vec2> nodes,
                                     std::span<const std::array<std::uint32_t, 3>> triangles) {
  if (triangles.empty()) return 0;
  double least = 2;  // above the value of an equilateral triangle, √3
  for (const auto& t : triangles)
    least = std::min(least, tanMinAngle(nodes[t[0]], nodes[t[1]], nodes[t[2]]));
  return std::atan(least);
}

}  // namespace yadefrag
