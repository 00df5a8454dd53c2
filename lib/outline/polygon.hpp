#pragma once
// Checks whether a polygon can be meshed.

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Returns the polygon with its outline counter-clockwise and its holes clockwise; a reversed loop
/// keeps its vertex 0 as the first. Throws InputError, which names the vertices, for fewer than
/// three points, values that are not finite, repeated points, zero area, edges that cross or touch,
/// holes outside the outline or inside another hole. All comparisons are exact.
[[nodiscard]] Polygon checkPolygon(Polygon polygon);

}  // namespace yadefrag
