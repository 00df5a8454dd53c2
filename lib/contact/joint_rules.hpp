#pragma once
// Entry by flags: which of its masters a slave is active on (paper §5.1, the outside-inside
// criterion, fig. 8), and the exceptions where two masters meet (§5.2, fig. 9):
//
// - case C of fig. 9: active on both, at a convex joint: the nearer one;
// - near a concave corner without an orthogonal foot on either: to the corner's node;
// - not in the paper: a slave that comes in past the end of one master, and was always behind the
//   line of the other, whose flag therefore says that it is none of that one's.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/footprint.hpp"
#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave against one of the masters that it is near to.
struct Trial {
  EntryId master;
  Foot foot;
  bool outside;  ///< flag
  bool opposed;  ///< do the outward normals of slave and master oppose each other
  bool active;
  bool hasFoot = true;  ///< is `foot` known already
};

/// Is a foot over its piece; at a joint of two, rounding leaves none between them.
template <class Geometry>
bool isOver(const Geometry& geometry, EntryId master, const Foot& foot) {
  const PieceRange range = geometry.range(master);
  return foot.xi >= range.begin - tolerance::kFootRange &&
         foot.xi <= range.end + tolerance::kFootRange;
}

/// Does the boundary turn towards the void between two pieces that follow each other.
template <class Geometry>
bool isConcaveJoint(const Geometry& geometry, EntryId first, EntryId second) {
  return cross(geometry.tangent(first, geometry.range(first).end),
               geometry.tangent(second, geometry.range(second).begin)) < 0;
}

/// §5.2 for all joints among one slave's masters, from their `active` and `outside`.
template <class Geometry>
void decideJoints(const ContactSurfaces& surfaces, const Geometry& geometry,
                  std::span<Trial> trials);

class JointRules {
 public:
  /// Sets `active` of all masters of one slave. Nothing is deeper in a smooth master than `deepest`
  /// (m), and nothing slides deeper in past an end than twice `reach` (m), the scan's.
  template <class Geometry>
  void decide(const ContactSurfaces& surfaces, const Geometry& geometry, std::span<Trial> trials,
              double deepest, double reach);
  void addTo(Footprint& footprint) const { footprint.add(Use::kSearch, joints_); }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joints_;  // trials, one after the other
};

}  // namespace yadefrag
