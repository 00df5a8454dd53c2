#pragma once
// Contact of a disc with one piece of a boundary. The contacts of all pieces together act as that
// of one continuous curve.

#include <optional>

#include "core/vec2.hpp"

namespace yadefrag {

struct BoundaryPiece {
  Vec2 start, middle, end;  ///< m; `middle`, of an arc only: its central node
  Vec2 before, after;  ///< unit tangents of the adjacent pieces at the junctions; zero: a free end
  bool isArc = false;

  [[nodiscard]] Vec2 tangentAtStart() const;
  [[nodiscard]] Vec2 tangentAtEnd() const;
};

struct DiscContact {
  double penetration;  ///< m, positive: overlap
  Vec2 normal;         ///< unit, out of the material
  double unshared;     ///< m, overlap with the piece alone: in a concave corner two pieces share it
};

/// The contact of this piece with a disc. No value if they do not touch, or if the contact point
/// belongs to an adjacent piece. Every point along a flat or convex boundary belongs to one piece:
/// a corner belongs to the piece that starts there. In a concave corner both sides push, minus
/// their common part, so that the force stays continuous as the corner becomes flat. If the disc's
/// centre is inside the material, by less than the radius, the nearest side pushes the disc out.
std::optional<DiscContact> discContact(const BoundaryPiece& piece, Vec2 centre, double radius);

}  // namespace yadefrag
