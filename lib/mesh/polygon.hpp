#pragma once
// Is a polygon one that can be meshed?

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The polygon with its outline counter-clockwise and its holes clockwise; a loop that is turned
/// round keeps its vertex 0 first. InputError, which names the vertices, for fewer than three
/// points, values that are not finite, repeated points, no area, edges that cross or touch, holes
/// outside the outline or inside another hole. All comparisons are exact.
[[nodiscard]] Polygon checkPolygon(Polygon polygon);

}  // namespace yadefrag
