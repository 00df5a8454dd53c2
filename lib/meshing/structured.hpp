#pragma once
// Regular meshes of rectangles.

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

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
