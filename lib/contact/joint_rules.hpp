#pragma once
// Which of its masters a slave is active on (paper §5.1, the outside-inside criterion, fig. 8), and
// the exceptions where two masters meet (§5.2, fig. 9):
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
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// A slave against one of the masters that it is near to.
struct Trial {
  EntryId master;
  Foot foot;
  bool outside;  ///< flag
  bool opposed;  ///< do the outward normals of slave and master oppose each other
  bool active;
};

class JointRules {
 public:
  /// Sets `active` of all masters of one slave. Nothing is deeper in a smooth master than `deepest`
  /// (m), and nothing slides deeper in past an end than twice `reach` (m), the scan's.
  template <class Geometry>
  void decide(const ContactSurfaces& surfaces, const Geometry& geometry, std::span<Trial> trials,
              double deepest, double reach);
  template <class Geometry>
  void decideByPath(const ContactSurfaces& surfaces, const Geometry& geometry,
                    std::span<Trial> trials);
  void addTo(Footprint& footprint) const { footprint.add(Use::kSearch, joints_); }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joints_;  // trials, one after the other
};

}  // namespace yadefrag
