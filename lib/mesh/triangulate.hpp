#pragma once
// A polygon becomes triangles.

#include <cmath>

#include "mesh/mesh_layout.hpp"
#include "mesh/size_field.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Constrained Delaunay triangles of edges about `size` (m). Each edge of the polygon is divided
/// into round(length/size) equal parts, at least one (see divideBoundary where the size varies);
/// those are all of the boundary nodes. Where the edges are shorter than `size` the triangles are
/// too, and grow inwards. Joints (see cutAtJoints) are divided likewise, and are sides of
/// triangles. The same input gives the same bits. InputError as divideBoundary, and where the
/// polygon is thinner than its coordinates' rounding.
[[nodiscard]] TriangleMesh triangulate(const Polygon& polygon, const SizeField& size,
                                       MeshLayout layout = {}, double mostBytes = INFINITY,
                                       const JointLines& joints = {});

}  // namespace yadefrag
