#pragma once
// A disc against one piece of a boundary, so that all pieces together push it as one curve does.

#include <optional>

#include "core/vec2.hpp"

namespace yadefrag {

struct BoundaryPiece {
  Vec2 start, middle, end;  ///< m; `middle` of an arc only: the node that it goes around
  Vec2 before, after;       ///< unit tangents of the neighbours at the joints; zero: a free end
  bool isArc = false;

  [[nodiscard]] Vec2 tangentAtStart() const;
  [[nodiscard]] Vec2 tangentAtEnd() const;
};

struct DiscContact {
  double penetration;  ///< m, positive: overlap
  Vec2 normal;         ///< unit, out of the material
};

/// The contact that this piece has with a disc; none where it does not touch or where the place
/// belongs to a neighbour. Every place along a flat or convex boundary belongs to one piece: a
/// corner to the piece that starts there. In a concave corner both sides push, less what they have
/// in common, so that the force stays continuous as the corner becomes flat. A disc whose centre is
/// inside the material, by less than its radius, is pushed out by the nearest side.
std::optional<DiscContact> discContact(const BoundaryPiece& piece, Vec2 centre, double radius);

}  // namespace yadefrag
