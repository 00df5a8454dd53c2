#pragma once
// Directional bias of a mesh, and the shape of its triangles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

/// Directions of undirected lines, 0° to 180°, in equal bins: bin i begins at i·180°/size.
struct MeshQuality {
  static constexpr std::size_t kDirections = 36;
  std::size_t numTriangles = 0;
  double shortestEdge = 0;  ///< m
  double longestEdge = 0;   ///< m
  double minAngle = 0;      ///< rad
  /// Number of inner edges in each direction, relative to a uniform distribution.
  std::array<double, kDirections> edges{};
  /// Mean ratio of the shortest path along edges to the straight line, by the line's direction; NaN
  /// for a direction without a line.
  std::array<double, kDirections> paths{};
  double meanPath = 0;       ///< mean of all lines; NaN without any
  double pathSpread = 0;     ///< largest minus smallest of `paths`
  double edgeDeviation = 0;  ///< largest |edges − 1|
};

/// Quality of a mesh. Nodes at the same position (the two faces of a crack) count as one. Paths are
/// measured from `sources` inner nodes, distributed over the mesh, to inner nodes at a distance of
/// 30 to 50 edges (or of 0.3 to 0.5 of √area if that is less), along lines that stay inside the
/// body.
[[nodiscard]] MeshQuality meshQuality(std::span<const Vec2> nodes,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      std::size_t sources = 200);

}  // namespace yadefrag
