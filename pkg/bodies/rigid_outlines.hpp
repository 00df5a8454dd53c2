#pragma once
// Sections of YADE's Wall, Box and Facet with the plane z = 0 of the finite-element bodies, as
// boundaries for contact with these. Facets that meet end to end are joined to one line.

#include <optional>
#include <string>
#include <vector>

#include "step/world.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

struct Section {
  enum class Kind { kOutline, kLine, kWall };
  Kind kind;
  /// m. Outline: its points, counter-clockwise. Line: its two ends. Wall, which is infinite: one of
  /// its points and a second one 1 m further along it, with the positive side on the right.
  std::vector<Vec2> points;
  int sense = 0;  ///< of a wall: the side with contact, 1 or -1; 0: both
};

/// True for a shape that can have a section.
[[nodiscard]] bool mayHaveSection(const yade::Body& body);
/// No value for a body that does not intersect the plane, and for a facet in the plane (`isFlat`).
[[nodiscard]] std::optional<Section> sectionOf(const yade::Body& body);
[[nodiscard]] bool isFlat(const yade::Body& body);
/// True for the section of a body that turns around x = 0 into itself: a wall across the axis, or a
/// box with its middle on it, which stands for a cylinder.
[[nodiscard]] bool isAroundAxis(const Section& section);
/// Numbers that change if the shape changes.
[[nodiscard]] std::vector<double> formOf(const yade::Shape& shape);

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
