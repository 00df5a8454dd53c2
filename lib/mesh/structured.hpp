#pragma once
// Regular meshes of rectangles.

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

enum class QuadPattern {
  kUnionJack,  ///< two triangles a quad, the diagonals of neighbours mirrored
  kCrossed,    ///< four triangles a quad, about a node in its middle: all masses balanced
};

/// A grid of nx × ny quads, cut in triangles. A union jack with even nx and ny is symmetric, with
/// equal masses at its four corners. Loop vertices are low, (high.x, low.y), high, (low.x, high.y).
[[nodiscard]] TriangleMesh structuredRectangle(Vec2 low, Vec2 high, int nx, int ny,
                                               QuadPattern pattern = QuadPattern::kUnionJack);

}  // namespace yadefrag
