#pragma once
// What YADE's Wall, Box and Facet are in the plane z = 0 of the finite-element bodies.

#include <optional>
#include <vector>

#include "abi/yade.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

struct Section {
  enum class Kind { kOutline, kLine, kWall };
  Kind kind;
  /// m; of an outline counter-clockwise, of a line its ends; of a wall one of its points, and the
  /// same 1 m further along it: it has no ends, and what is on its right is its positive side.
  std::vector<Vec2> points;
  int sense = 0;  ///< of a wall: the one side that touches, 1 or -1; 0: both
};

/// Is it of a shape that may have a section.
[[nodiscard]] bool mayHaveSection(const yade::Body& body);
/// Nothing for a body that does not cut the plane, and for a facet that lies in it (`isFlat`).
[[nodiscard]] std::optional<Section> sectionOf(const yade::Body& body);
[[nodiscard]] bool isFlat(const yade::Body& body);
/// Numbers that tell whether the shape has changed.
[[nodiscard]] std::vector<double> formOf(const yade::Shape& shape);

}  // namespace yadefrag
