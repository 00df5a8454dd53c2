#pragma once
// Order along the Lebesgue curve: what is near in the plane becomes near in memory.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The indices of the points in the order in which the curve meets them; points of one code in
/// their own order. The curve's grid has 2^20 boxes along the longer side of all points.
[[nodiscard]] std::vector<std::uint32_t> orderAlongCurve(std::span<const Vec2> points);

/// Renumbers the nodes by position and the triangles by centroid; each triangle begins with its
/// least node, the loops with their own first.
void numberAlongCurve(TriangleMesh& mesh);

}  // namespace yadefrag
