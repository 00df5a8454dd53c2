#pragma once
// Numbering along the Lebesgue curve: points that are near in the plane are near in memory.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The indices of the points in their order along the curve; points with the same code keep their
/// order. The curve's grid has 2^20 boxes along the longer side of the bounding box.
[[nodiscard]] std::vector<std::uint32_t> orderAlongCurve(std::span<const Vec2> points);

/// Renumbers the nodes by position and the triangles by centroid. Each triangle then begins with
/// its lowest node, each loop, too. Returns the former number of each node.
std::vector<std::uint32_t> numberAlongCurve(TriangleMesh& mesh);

}  // namespace yadefrag
