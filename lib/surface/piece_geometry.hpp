#pragma once
// Geometry of boundary pieces, arcs and straight ones.

#include <array>
#include <span>

#include "core/box.hpp"
#include "core/vec2.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

// --- The smooth boundary around a node b between its neighbours a and c (paper eq. 2, fig. 1): the
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

// --- The geometry of a contact surface's entries at given node positions (m).

/// Values of ξ at which a piece begins and ends.
struct PieceRange {
  double begin = 0;
  double end = 1;
};

inline PieceRange pieceRange(Piece piece) {
  return {piece == Piece::kSecondHalf ? .5 : 0., piece == Piece::kFirstHalf ? .5 : 1.};
}

/// The point, displacement or velocity that a stencil defines.
inline Vec2 combine(const Stencil& stencil, std::span<const Vec2> values) {
  Vec2 sum = stencil.weight[0] * values[stencil.node[0].value];
  for (int i = 1; i < stencil.count; ++i) sum += stencil.weight[i] * values[stencil.node[i].value];
  return sum;
}

struct PieceEnds {
  Vec2 begin, end;
};

/// Stores references only: both arguments must outlive it.
class PieceGeometry {
 public:
  PieceGeometry(const ContactSurfaces& surfaces, std::span<const Vec2> positions)
      : surfaces_(surfaces), positions_(positions) {}

  [[nodiscard]] std::span<const Vec2> positions() const { return positions_; }
  [[nodiscard]] bool isArc(EntryId entry) const {
    return surfaces_.piece[entry.value] == Piece::kArc;
  }
  [[nodiscard]] PieceRange range(EntryId entry) const {
    return pieceRange(surfaces_.piece[entry.value]);
  }

  [[nodiscard]] PieceEnds ends(EntryId entry) const {
    return {slave(entry), slave(surfaces_.next[entry.value])};
  }
  /// Smallest box around a straight piece; for an arc, around its four control points. z = 0.
  [[nodiscard]] Box box(EntryId entry) const;
  /// (m) Height of an arc over its chord: a point near the arc is near the chord up to this height.
  [[nodiscard]] double bulge(EntryId arc, const PieceEnds& ends) const {
    return norm(corners(arc).b - .5 * (ends.begin + ends.end));
  }
  /// m, length of the piece; that of an arc by quadrature, with an error of a thousandth even at a
  /// sharp node.
  [[nodiscard]] double length(EntryId entry) const;
  [[nodiscard]] Vec2 point(EntryId entry, double xi) const {
    return combine(surfaces_.master(entry, xi), positions_);
  }
  /// dx/dξ (m); for a straight piece that of the whole segment.
  [[nodiscard]] Vec2 tangent(EntryId entry, double xi) const;

  /// The entry's sampling point: that of `ContactSurfaces::slave`, without computing the stencil.
  [[nodiscard]] Vec2 slave(EntryId entry) const {
    const SegmentId segment = surfaces_.entrySegment[entry.value];
    const Vec2 a = positions_[surfaces_.segmentNode[segment.value].value];
    const Piece piece = surfaces_.piece[entry.value];
    if (piece == Piece::kSegment || piece == Piece::kFirstHalf) return a;
    const SegmentId following = surfaces_.segmentNext[segment.value];
    return .5 * a + .5 * positions_[surfaces_.segmentNode[following.value].value];
  }

  /// The foot of a point. On a straight piece ξ is that of the whole segment, without limits.
  [[nodiscard]] Foot foot(EntryId entry, Vec2 point) const;

 private:
  struct Corners {
    Vec2 a, b, c;
    bool arc;
  };
  [[nodiscard]] Corners corners(EntryId entry) const {
    const SegmentId segment = surfaces_.entrySegment[entry.value];
    const SegmentId second = surfaces_.segmentNext[segment.value];
    const Vec2 a = positions_[surfaces_.segmentNode[segment.value].value];
    const Vec2 b = positions_[surfaces_.segmentNode[second.value].value];
    if (!isArc(entry)) return {a, b, {}, false};
    const SegmentId third = surfaces_.segmentNext[second.value];
    return {a, b, positions_[surfaces_.segmentNode[third.value].value], true};
  }

  const ContactSurfaces& surfaces_;
  std::span<const Vec2> positions_;
};

}  // namespace yadefrag
