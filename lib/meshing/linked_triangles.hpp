#pragma once
// A mesh under construction: each triangle stores its neighbours.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

struct LinkedTriangles {
  static constexpr std::uint32_t kNone = 0xffffffff;
  using Three = std::array<std::uint32_t, 3>;

  std::vector<Vec2> nodes;        ///< m
  std::uint32_t numBoundary = 0;  ///< number of boundary nodes; these come first and must not move
  std::vector<Three> triangles;   ///< counter-clockwise
  /// Neighbour across the side opposite to each node, or kNone: on the boundary, and on joints,
  /// whose sides must not be flipped.
  std::vector<Three> neighbours;

  [[nodiscard]] Vec2 at(std::uint32_t triangle, int corner) const {
    return nodes[triangles[triangle][corner]];
  }

  /// The corner of `triangle` opposite to its side to `neighbour`.
  [[nodiscard]] int cornerAcross(std::uint32_t triangle, std::uint32_t neighbour) const {
    const Three& n = neighbours[triangle];
    return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
  }
  [[nodiscard]] int cornerOf(std::uint32_t triangle, std::uint32_t node) const {
    const Three& t = triangles[triangle];
    return t[0] == node ? 0 : t[1] == node ? 1 : 2;
  }
};

}  // namespace yadefrag
