#include "surface/disc_contact.hpp"

#include <algorithm>

#include "surface/piece_geometry.hpp"

namespace yadefrag {
namespace {

Vec2 unit(Vec2 a) {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec2{};
}

bool isNone(Vec2 tangent) { return tangent == Vec2{}; }

enum class Owner { kBefore, kCorner, kAfter, kBoth };

/// A junction of two pieces relative to a point. It is computed from the same numbers for both
/// pieces, so that their results agree to the last bit.
struct Junction {
  Vec2 from;           ///< from the corner to the point
  Vec2 arrive, leave;  ///< tangents
  double past, ahead;  ///< distance of the point beyond the end of one, and along the other

  Junction(Vec2 corner, Vec2 t0, Vec2 t1, Vec2 point)
      : from(point - corner), arrive(t0), leave(t1), past(dot(from, t0)), ahead(dot(from, t1)) {}

  [[nodiscard]] bool isConcave() const { return cross(arrive, leave) < 0; }

  [[nodiscard]] Owner owner() const {
    if (past >= 0) return ahead < 0 ? Owner::kCorner : Owner::kAfter;
    if (ahead < 0) return Owner::kBefore;
    if (isConcave()) return Owner::kBoth;
    // Inside a convex corner, or with rounding at a flat junction: the side nearer to the void.
    return dot(from, rightOf(arrive)) >= dot(from, rightOf(leave)) ? Owner::kBefore : Owner::kAfter;
  }

  /// The part of the overlap with the corner itself that the preceding piece does not count if both
  /// sides push. It increases from zero to all of it as the point moves out of that piece's range.
  [[nodiscard]] double sharedByBefore(double radius) const {
    return overlap(radius) * ahead / (ahead - past);
  }
  [[nodiscard]] double sharedByAfter(double radius) const {
    return overlap(radius) * -past / (ahead - past);
  }

  [[nodiscard]] DiscContact corner(double radius) const {
    const double distance = norm(from);
    const Vec2 out = rightOf(arrive) + rightOf(leave);
    const bool inside = dot(from, out) < 0 && (isConcave() || dot(arrive, leave) > 0);
    const Vec2 normal = distance > 0 ? (1 / distance) * from : unit(out);
    const double depth = inside ? radius + distance : radius - distance;
    return {depth, inside ? -normal : normal, depth};
  }

 private:
  [[nodiscard]] double overlap(double radius) const { return std::max(radius - norm(from), 0.); }
};

DiscContact freeEnd(Vec2 at, Vec2 outward, Vec2 centre, double radius) {
  const Vec2 from = centre - at;
  const double distance = norm(from);
  const double depth = radius - distance;
  return {depth, distance > 0 ? (1 / distance) * from : outward, depth};
}

/// The foot of a point that lies beside the piece.
Foot footOn(const BoundaryPiece& piece, Vec2 point) {
  if (piece.isArc) {
    const Vec2 before = 2 * piece.start - piece.middle, after = 2 * piece.end - piece.middle;
    return nearestOnArc(before, piece.middle, after, point);
  }
  Foot foot;
  foot.normal = rightOf(unit(piece.end - piece.start));
  foot.gap = dot(point - piece.start, foot.normal);
  return foot;
}

}  // namespace

Vec2 BoundaryPiece::tangentAtStart() const { return unit((isArc ? middle : end) - start); }
Vec2 BoundaryPiece::tangentAtEnd() const { return unit(end - (isArc ? middle : start)); }

std::optional<DiscContact> discContact(const BoundaryPiece& piece, Vec2 centre, double radius) {
  const Vec2 leave = piece.tangentAtStart(), arrive = piece.tangentAtEnd();
  double shared = 0;
  if (isNone(piece.before)) {
    if (dot(centre - piece.start, leave) < 0) {
      const DiscContact cap = freeEnd(piece.start, -leave, centre, radius);
      return cap.penetration > 0 ? std::optional(cap) : std::nullopt;
    }
  } else {
    const Junction junction(piece.start, piece.before, leave, centre);
    const Owner owner = junction.owner();
    if (owner == Owner::kBefore) return {};
    if (owner == Owner::kCorner) {
      const DiscContact corner = junction.corner(radius);
      const bool counts = corner.penetration > 0 && corner.penetration < 2 * radius;
      return counts ? std::optional(corner) : std::nullopt;
    }
    if (owner == Owner::kBoth) shared += junction.sharedByAfter(radius);
  }
  if (isNone(piece.after)) {
    if (dot(centre - piece.end, arrive) >= 0) {
      const DiscContact cap = freeEnd(piece.end, arrive, centre, radius);
      return cap.penetration > 0 ? std::optional(cap) : std::nullopt;
    }
  } else {
    const Junction junction(piece.end, arrive, piece.after, centre);
    const Owner owner = junction.owner();
    if (owner == Owner::kAfter || owner == Owner::kCorner) return {};
    if (owner == Owner::kBoth) shared += junction.sharedByBefore(radius);
  }
  const Foot foot = footOn(piece, centre);
  const double penetration = radius - foot.gap - shared;
  if (!(penetration > 0) || foot.gap <= -radius) return {};
  return DiscContact{penetration, foot.normal, radius - foot.gap};
}

}  // namespace yadefrag
