#pragma once
// Sections of YADE's bodies as boundaries for contact with finite-element bodies. Facets that meet
// end to end are joined to one line.

#include <vector>

#include "rigid/rigid_section.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// `after`: m, ends of a line after the step; `mover`: the body that moves it by forces.
struct RigidPart {
  static constexpr yade::Body::id_t kHeld = -1;  ///< forces do not move it
  Section section;
  std::vector<Vec2> after;
  double friction;
  std::string name;
  yade::Body::id_t mover = kHeld;
};

/// `part`, by node: the number of the part whose side begins at the node.
struct RigidOutline {
  RigidSpec spec;
  std::vector<std::uint32_t> part;
};

/// Outlines in the order of their first parts. Where more than two lines meet, or lines of
/// different friction or movers, each line has an end. Walls extend `reach` (m) on both sides of
/// their point nearest to `middle`.
[[nodiscard]] std::vector<RigidOutline> outlinesOf(const std::vector<RigidPart>& parts, Vec2 middle,
                                                   double reach);

}  // namespace yadefrag
