#pragma once
// The geometry of a contact surface's entries at given node positions (m).

#include <span>

#include "core/box.hpp"
#include "surface/bezier_arc.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

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
