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

/// `kSmooth` false: for surfaces without any smooth part, whose pieces are all whole segments; the
/// arrays for arcs are then not accessed.
template <bool kSmooth>
class PieceGeometryOf {
 public:
  /// This object stores references only: all arguments must outlive it. `points`: m, by entry, the
  /// results of `slave` at these positions, if they are known already; this saves two indirections
  /// each.
  PieceGeometryOf(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                  std::span<const Vec2> points = {})
      : surfaces_(surfaces), positions_(positions), points_(points) {}

  [[nodiscard]] std::span<const Vec2> positions() const { return positions_; }
  [[nodiscard]] bool isArc(EntryId entry) const {
    return kSmooth && surfaces_.piece[entry.value] == Piece::kArc;
  }
  [[nodiscard]] PieceRange range(EntryId entry) const {
    return kSmooth ? pieceRange(surfaces_.piece[entry.value]) : PieceRange{};
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
  [[nodiscard]] Vec2 point(EntryId entry, double xi) const;
  /// dx/dξ (m); for a straight piece that of the whole segment.
  [[nodiscard]] Vec2 tangent(EntryId entry, double xi) const {
    if (!isWhole(entry)) return tangentOfOther(entry, xi);
    const PieceEnds e = ends(entry);
    return e.end - e.begin;
  }
  /// Unit outward normal at ξ; zero if the tangent vanishes.
  [[nodiscard]] Vec2 normal(EntryId entry, double xi) const {
    return unitOrZero(rightOf(tangent(entry, xi)));
  }

  /// The entry's sampling point: that of `ContactSurfaces::slave`, without computing the stencil.
  [[nodiscard]] Vec2 slave(EntryId entry) const {
    if (!points_.empty()) return points_[entry.value];
    const SegmentId segment = surfaces_.entrySegment[entry.value];
    const Vec2 a = positions_[surfaces_.segmentNode[segment.value].value];
    if constexpr (!kSmooth) return a;
    const Piece piece = surfaces_.piece[entry.value];
    if (piece == Piece::kSegment || piece == Piece::kFirstHalf) return a;
    const SegmentId following = surfaces_.segmentNext[segment.value];
    return .5 * a + .5 * positions_[surfaces_.segmentNode[following.value].value];
  }

  /// The foot of a point. On a straight piece ξ is that of the whole segment, without limits.
  [[nodiscard]] Foot foot(EntryId entry, Vec2 point) const {
    if (!isWhole(entry)) return footOnOther(entry, point);
    const PieceEnds e = ends(entry);
    return footOnSegment(e.begin, e.end, point, {});
  }

 private:
  /// True for a segment between two corners. Most entries are of this kind and need their ends
  /// only.
  [[nodiscard]] bool isWhole(EntryId entry) const {
    return !kSmooth || surfaces_.piece[entry.value] == Piece::kSegment;
  }
  static Vec2 unitOrZero(Vec2 a) {
    const double length = norm(a);
    return length > 0 ? (1 / length) * a : Vec2{};
  }
  static Foot footOnSegment(Vec2 a, Vec2 b, Vec2 point, PieceRange within) {
    const Vec2 along = b - a;
    const double square = dot(along, along);
    Foot foot;
    foot.xi = square > 0 ? dot(point - a, along) / square : within.begin;
    foot.normal = unitOrZero(rightOf(along));
    foot.gap = dot(point - a, foot.normal);
    foot.inside = foot.xi >= within.begin && foot.xi <= within.end;
    return foot;
  }
  [[nodiscard]] Vec2 tangentOfOther(EntryId entry, double xi) const;
  [[nodiscard]] Foot footOnOther(EntryId entry, Vec2 point) const;

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
  std::span<const Vec2> points_;
};

extern template class PieceGeometryOf<true>;
extern template class PieceGeometryOf<false>;
/// For any surface.
using PieceGeometry = PieceGeometryOf<true>;

/// Calls `work` with the geometry class for these surfaces.
template <class Work>
auto withGeometry(const ContactSurfaces& surfaces, std::span<const Vec2> positions, Work work,
                  std::span<const Vec2> points = {}) {
  if (surfaces.anySmooth()) return work(PieceGeometryOf<true>(surfaces, positions, points));
  return work(PieceGeometryOf<false>(surfaces, positions, points));
}

}  // namespace yadefrag
