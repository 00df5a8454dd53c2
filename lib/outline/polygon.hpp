#pragma once
// Reads polygons from text, and checks whether they can be meshed.

#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Loops of points: one point `x y` (m) per line, an empty line between two loops; the first loop
/// is the outline. `#` begins a comment, and a line with only a comment is skipped. Throws
/// InputError, with the line number, for anything else. Does not check whether the loops can be
/// meshed.
[[nodiscard]] Polygon polygonFromText(std::string_view text);

/// Returns the polygon with its outline counter-clockwise and its holes clockwise; a reversed loop
/// keeps its vertex 0 as the first. Throws InputError, which names the vertices, for fewer than
/// three points, values that are not finite, repeated points, zero area, edges that cross or touch,
/// holes outside the outline or inside another hole. All comparisons are exact.
[[nodiscard]] Polygon checkPolygon(Polygon polygon);

}  // namespace yadefrag
