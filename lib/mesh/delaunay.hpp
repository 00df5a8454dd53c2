#pragma once
// The constrained Delaunay triangulation of given nodes.

#include <span>

#include "mesh/divided_boundary.hpp"
#include "mesh/linked_triangles.hpp"

namespace yadefrag {

/// All triangles between the loops of a boundary, joints among their sides, with nodes inside where
/// they are strictly inside. Nodes are the boundary's in their order, then those of `inside` that
/// were used. InputError if dividing the edges made loops meet.
[[nodiscard]] LinkedTriangles triangulateNodes(const DividedBoundary& boundary,
                                               std::span<const Vec2> inside);

}  // namespace yadefrag
