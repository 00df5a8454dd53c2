#pragma once
// Sections of YADE's Wall, Box and Facet with the plane z = 0 of the finite-element bodies.

#include <optional>
#include <vector>

#include "abi/yade.hpp"
#include "core/vec2.hpp"

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
/// Numbers that change if the shape changes.
[[nodiscard]] std::vector<double> formOf(const yade::Shape& shape);

}  // namespace yadefrag
