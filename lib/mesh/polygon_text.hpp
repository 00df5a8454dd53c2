#pragma once
// Polygons as text.

#include <string_view>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Loops of points, `x y` (m) on each line, with an empty line between two loops; the first one is
/// the outline. `#` begins a comment, and a line with nothing but a comment is skipped. Throws
/// InputError, with the number of the line, for anything else. Nothing is said of whether the
/// loops can be meshed.
[[nodiscard]] Polygon polygonFromText(std::string_view text);

}  // namespace yadefrag
