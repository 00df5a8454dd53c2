#pragma once
// Reads polygons from text.

#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Loops of points: one point `x y` (m) per line, an empty line between two loops; the first loop
/// is the outline. `#` begins a comment, and a line with only a comment is skipped. Throws
/// InputError, with the line number, for anything else. Does not check whether the loops can be
/// meshed.
[[nodiscard]] Polygon polygonFromText(std::string_view text);

}  // namespace yadefrag
