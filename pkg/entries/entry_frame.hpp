#pragma once

#include <algorithm>

#include "step/world.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// The middle of a piece of the boundary, and the two nodes that determine its rotation: moments
/// act as a pair of forces on them.
struct EntryFrame {
  Stencil middle;
  NodeId first, last;

  EntryFrame(const ContactSurfaces& surfaces, EntryId entry) {
    NodeId nodes[3];
    const int count = surfaces.pieceNodes(entry, nodes);
    first = nodes[0], last = nodes[count - 1];
    const PieceRange range = pieceRange(surfaces.piece[entry.value]);
    middle = surfaces.master(entry, .5 * (range.begin + range.end));
  }
};

/// The point of a piece nearest to `point`, where the force of a contact acts.
inline Stencil footOf(const ContactSurfaces& surfaces, const PieceGeometry& geometry, EntryId entry,
                      Vec2 point) {
  const PieceRange range = geometry.range(entry);
  return surfaces.master(entry, std::clamp(geometry.foot(entry, point).xi, range.begin, range.end));
}

}  // namespace yadefrag
