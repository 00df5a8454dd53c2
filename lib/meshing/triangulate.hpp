#pragma once
// Meshes of polygons and of rectangles.

#include <cmath>

#include "mesh/triangle_mesh.hpp"
#include "meshing/joint_lines.hpp"
#include "meshing/size_field.hpp"

namespace yadefrag {

/// With what has been joined of the joints.
struct PolygonMesh : TriangleMesh {
  JoinedTraces joined;
};

/// Constrained Delaunay triangles with edges of about `size` (m). Each edge of the polygon is
/// divided into round(length/size) equal parts, at least one (see divideBoundary for a variable
/// size); the boundary has no other nodes. Where the polygon's edges are shorter than `size`, the
/// triangles are small, too, and grow inwards. Joints (see cutAtJoints) are divided in the same
/// way, and are sides of triangles. The same input gives the same bits; in another unit of length,
/// or elsewhere, it gives the same triangles, unless coordinates are larger than 10⁶ sizes. Throws
/// InputError as divideBoundary, and if the polygon is thinner than the rounding of its
/// coordinates.
[[nodiscard]] PolygonMesh triangulate(const Polygon& polygon, const SizeField& size,
                                      MeshLayout layout = {}, double mostBytes = INFINITY,
                                      const JointLines& joints = {}, double jointTolerance = 0);

enum class QuadPattern {
  kUnionJack,  ///< two triangles per quad, diagonals of adjacent quads mirrored
  kCrossed,    ///< four triangles per quad around a central node: balanced masses
};

/// A grid of nx × ny quads, divided into triangles. A union jack with even nx and ny is symmetric,
/// with equal masses at its four corners. Loop vertices are low, (high.x, low.y), high, (low.x,
/// high.y).
[[nodiscard]] TriangleMesh structuredRectangle(Vec2 low, Vec2 high, int nx, int ny,
                                               QuadPattern pattern = QuadPattern::kUnionJack);

}  // namespace yadefrag
