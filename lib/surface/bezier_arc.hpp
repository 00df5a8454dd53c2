#pragma once
// The smooth boundary around a node b between its neighbours a and c (paper eq. 2, fig. 1): the
// cubic Bézier curve from the halfpoint of ab (ξ = 0) to that of bc (ξ = 1) whose inner control
// points are the quarterpoints (a+3b)/4 and (3b+c)/4.
//
//              b               H  halfpoints of ab and bc: the arc begins and ends there, with the
//            Q   Q             directions of the segments, so that adjacent arcs have no corner
//           ╱ ⌒⌒ ╲             Q  quarterpoints, at half the way from H to b
//         H╱      ╲H
//         ╱        ╲
//        a          c
//
// Its tangent ¾[(1−ξ²)(b−a) + (2ξ−ξ²)(c−b)]
// rotates in one direction only, from the first segment's to the second's: an arc has no
// inflection.

#include <array>

#include "core/vec2.hpp"

namespace yadefrag {

using ArcWeights = std::array<double, 3>;

/// h₁, h₂, h₃ of eq. 2; they sum to 1.
inline ArcWeights arcShape(double xi) {
  const double square = xi * xi;
  const double cube = square * xi;
  return {.25 * (2 - 3 * xi + cube), .25 * (2 + 3 * xi - 3 * square), .25 * (3 * square - cube)};
}

/// dhᵢ/dξ.
inline ArcWeights arcShapeDerivative(double xi) {
  const double square = xi * xi;
  return {.75 * (square - 1), .75 * (1 - 2 * xi), .75 * (2 * xi - square)};
}

inline Vec2 combine(const ArcWeights& h, Vec2 a, Vec2 b, Vec2 c) {
  return h[0] * a + h[1] * b + h[2] * c;
}

/// The projection of a point on a boundary piece.
struct Foot {
  /// Beyond an end the piece is extended along its tangent: ξ < 0 or ξ > 1 on an arc.
  double xi = 0;
  double gap = 0;       ///< m, along the normal: positive on the void side
  Vec2 normal;          ///< unit, outward
  bool inside = false;  ///< ξ is in the piece's range: the foot is orthogonal and on the piece
};

/// The orthogonal foot nearest to the point (a point deep inside a sharp arc has up to three), by
/// Newton–Raphson iteration in a bracket with exactly one root. Without an orthogonal foot: the
/// nearer end, `inside` false, and ξ and gap relative to the tangent there.
Foot nearestOnArc(Vec2 a, Vec2 b, Vec2 c, Vec2 point);

}  // namespace yadefrag
