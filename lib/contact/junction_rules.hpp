#pragma once
// Exceptions where two masters meet (paper §5.2).
//
//          C              Fig. 9: a slave is inside a sharp corner (x), nearer to the right face.
//     A    ╱╲    B        At xⁿ it was at A, B or C. From A it has entered through the left face:
//         ╱  ╲            it is active on that one only, and a correction to the nearer face would
//        ╱   x╲           accelerate it. From B it is active on the right face, from C on both.
//       ╱ body ╲
//
// - Case C, active on both pieces at a convex junction: the nearer one.
// - Near a concave corner without an orthogonal foot on either: correction to the corner's node.

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

/// True if a foot is over its piece; at a junction, rounding leaves no gap between two pieces.
template <class Geometry>
bool isOver(const Geometry& geometry, EntryId master, const Foot& foot) {
  const PieceRange range = geometry.range(master);
  return foot.xi >= range.begin - tolerance::kFootRange &&
         foot.xi <= range.end + tolerance::kFootRange;
}

/// True if the boundary turns towards the void between two successive pieces.
template <class Geometry>
bool isConcaveJunction(const Geometry& geometry, EntryId first, EntryId second) {
  return cross(geometry.tangent(first, geometry.range(first).end),
               geometry.tangent(second, geometry.range(second).begin)) < 0;
}

/// Changes `active` at all junctions among one slave's masters.
template <class Geometry>
void decideJunctions(const ContactSurfaces& surfaces, const Geometry& geometry,
                     std::span<Trial> trials);

}  // namespace yadefrag
