#pragma once
// Makes triangles more equilateral.

#include "mesh/linked_triangles.hpp"

namespace yadefrag {

/// Moves inner nodes and flips inner edges until the triangles are Delaunay again and their
/// smallest angles have grown; with `evenHeights`, also their smallest heights, on which the time
/// step depends: among scattered nodes some triangles are far smaller than their neighbours.
void improve(LinkedTriangles& mesh, bool evenHeights = false);

}  // namespace yadefrag
