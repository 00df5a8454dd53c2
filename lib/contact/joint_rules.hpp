#pragma once
// Entry by flags: selects the masters on which a slave is active (paper §5.1, the outside-inside
// criterion, fig. 8), with the exceptions where two masters meet (§5.2, fig. 9):
//
// - case C of fig. 9: active on both, at a convex joint: the nearer one;
// - near a concave corner without an orthogonal foot on either: correction to the corner's node;
// - not in the paper: a slave that enters past the end of one master, and was always behind the
//   line of the other, whose flag therefore excludes it.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/footprint.hpp"
#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave and one of its near masters.
struct Trial {
  EntryId master;
  Foot foot;
  bool outside;  ///< flag
  bool opposed;  ///< true: the outward normals of slave and master are opposed
  bool active;
  bool hasFoot = true;  ///< true: `foot` is already computed
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

/// The rules of §5.2 for all joints among one slave's masters, from their `active` and `outside`.
template <class Geometry>
void decideJoints(const ContactSurfaces& surfaces, const Geometry& geometry,
                  std::span<Trial> trials);

class JointRules {
 public:
  /// Sets `active` for all masters of one slave. Depths in a smooth master beyond `deepest` (m) are
  /// ignored, and so are slaves that slid in past an end deeper than twice `reach` (m) of the scan.
  template <class Geometry>
  void decide(const ContactSurfaces& surfaces, const Geometry& geometry, std::span<Trial> trials,
              double deepest, double reach);
  void addTo(Footprint& footprint) const { footprint.add(Use::kSearch, joints_); }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joints_;  // pairs of successive trials
};

}  // namespace yadefrag
