#pragma once
// The constrained Delaunay triangulation of given nodes.

#include <span>

#include "meshing/divided_boundary.hpp"
#include "meshing/linked_triangles.hpp"

namespace yadefrag {

/// All triangles between the loops of a boundary. Joints become sides of triangles. A point of
/// `inside` becomes a node only if it is strictly inside. The nodes are those of the boundary, in
/// their order, then the used points of `inside`. Throws InputError if the division of the edges
/// made loops meet.
[[nodiscard]] LinkedTriangles triangulateNodes(const DividedBoundary& boundary,
                                               std::span<const Vec2> inside);

}  // namespace yadefrag
