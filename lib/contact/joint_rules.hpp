#pragma once
// Exceptions where two masters meet (paper §5.2, fig. 9):
//
// - case C of fig. 9: active on both, at a convex joint: the nearer one;
// - near a concave corner without an orthogonal foot on either: correction to the corner's node.

#include <span>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave and one of its near masters.
struct Trial {
  EntryId master;
  Foot foot = {};
  bool hasFoot = false;  ///< true: `foot` is already computed
  bool opposed = false;  ///< true: the outward normals of slave and master are opposed
  bool entered = false;  ///< true: the slave has entered this master
  bool active = false;
};

/// True if a foot is over its piece; at a joint of two pieces, rounding leaves no gap between them.
template <class Geometry>
bool isOver(const Geometry& geometry, EntryId master, const Foot& foot) {
  const PieceRange range = geometry.range(master);
  return foot.xi >= range.begin - tolerance::kFootRange &&
         foot.xi <= range.end + tolerance::kFootRange;
}

/// True if the boundary turns towards the void between two successive pieces.
template <class Geometry>
bool isConcaveJoint(const Geometry& geometry, EntryId first, EntryId second) {
  return cross(geometry.tangent(first, geometry.range(first).end),
               geometry.tangent(second, geometry.range(second).begin)) < 0;
}

/// Changes `active` at all joints among one slave's masters.
template <class Geometry>
void decideJoints(const ContactSurfaces& surfaces, const Geometry& geometry,
                  std::span<Trial> trials);

}  // namespace yadefrag
