#pragma once
// Sections of YADE's bodies as boundaries that finite-element bodies touch: facets that meet end to
// end are one line.

#include <vector>

#include "fe/rigid_section.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// `after`: m, of a line, its ends after the step.
struct RigidPart {
  Section section;
  std::vector<Vec2> after;
  double friction;
  std::string name;
};

/// `part`, by node: the number of the part whose side leaves the node.
struct RigidOutline {
  RigidSpec spec;
  std::vector<std::uint32_t> part;
};

/// In the order of their first parts. Where more than two lines meet, or lines of different
/// friction, each has an end. Walls are `reach` (m) long on both sides of the place on them that is
/// nearest to `middle`.
[[nodiscard]] std::vector<RigidOutline> outlinesOf(const std::vector<RigidPart>& parts, Vec2 middle,
                                                   double reach);

}  // namespace yadefrag
