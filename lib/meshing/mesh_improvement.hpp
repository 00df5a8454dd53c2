#pragma once
// Improves the shape of triangles.

#include "meshing/linked_triangles.hpp"

namespace yadefrag {

/// Moves inner nodes and flips inner edges until the triangles are Delaunay again and their
/// smallest angles have grown. With `evenHeights` it also increases the smallest heights, on which
/// the time step depends: with scattered nodes some triangles are far smaller than their
/// neighbours.
void improve(LinkedTriangles& mesh, bool evenHeights = false);

}  // namespace yadefrag
