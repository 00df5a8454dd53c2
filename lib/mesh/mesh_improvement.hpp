#pragma once
// Makes triangles more equilateral.

#include "mesh/linked_triangles.hpp"

namespace yadefrag {

/// Moves inner nodes and flips inner edges until the triangles are Delaunay again and their
/// smallest angles have grown.
void improve(LinkedTriangles& mesh);

}  // namespace yadefrag
