#pragma once
// How much a mesh prefers directions, and how good its triangles are.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

/// The 180° of directions of an undirected line, in equal parts: bin i begins at i·180°/size.
struct MeshQuality {
  static constexpr std::size_t kDirections = 36;
  std::size_t numTriangles = 0;
  double shortestEdge = 0;  ///< m
  double longestEdge = 0;   ///< m
  double minAngle = 0;      ///< rad
  /// Inner edges in each direction over those of an even distribution.
  std::array<double, kDirections> edges{};
  /// Mean of shortest path along edges over straight line, by the line's direction; NaN where no
  /// line was measured.
  std::array<double, kDirections> paths{};
  double meanPath = 0;       ///< of all lines; NaN without any
  double pathSpread = 0;     ///< largest minus smallest of `paths`
  double edgeDeviation = 0;  ///< largest |edges − 1|
};

/// Quality of a mesh. Nodes at the same place (the two faces of a crack) count as one. Paths are
/// measured from `sources` inner nodes, spread over the mesh, to inner nodes that 30 to 50 edges
/// would reach (or 0.3 to 0.5 of √area if that is less), along lines that stay in the body.
[[nodiscard]] MeshQuality meshQuality(std::span<const Vec2> nodes,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      std::size_t sources = 200);

}  // namespace yadefrag
