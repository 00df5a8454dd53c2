#pragma once
// A slave enters where its path in the step crosses the moving piece.

#include <optional>

#include "core/vec2.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A point and a straight piece at one time.
struct PointAndPiece {
  Vec2 point;
  PieceEnds piece;
};

/// The crossing of a point from the void side through the line of a piece, where both move linearly
/// from `before` to `now`.
struct Crossing {
  double time;  ///< fraction of the step, 0 to 1
  double xi;    ///< on the piece: 0 at its begin, 1 at its end
};

/// The time at which the point is `depth` (m) behind the line, or the end of the step if it is
/// behind the line by less then. No value if it is in front of the line at the end, or was deeper
/// all the time. The gap, times the piece's length, is a quadratic in time.
std::optional<Crossing> crossing(const PointAndPiece& before, const PointAndPiece& now,
                                 double depth);

}  // namespace yadefrag
