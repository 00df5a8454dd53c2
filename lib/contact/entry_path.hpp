#pragma once
// Entry by the path: a slave comes in where its way through the step crosses the moving piece.

#include <optional>

#include "core/vec2.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A point and a straight piece at one time.
struct PointAndPiece {
  Vec2 point;
  PieceEnds piece;
};

/// Where a point goes through the line of a piece from its void side, both moving straight from
/// `before` to `now`.
struct Crossing {
  double time;  ///< of the step, 0 to 1
  double xi;    ///< of the piece: 0 at its begin, 1 at its end
};

/// The time at which the point gets `depth` (m) behind the line, or the end of the step if it is
/// behind it by less then; nothing if it is before the line at the end, or was deeper all the time.
/// The gap, times the piece's length, is a quadratic in time.
std::optional<Crossing> crossing(const PointAndPiece& before, const PointAndPiece& now,
                                 double depth);

}  // namespace yadefrag
