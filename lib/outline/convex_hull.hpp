#pragma once
// Convex hull of points, and its smallest width.

#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

/// Convex hull, counter-clockwise, without collinear or coincident points up to `rounding` (m).
[[nodiscard]] std::vector<Vec2> hullOf(std::vector<Vec2> points, double rounding);

/// (m) The least distance between two parallel lines with all the points between them; 0 if they
/// are on one line. One of the lines has a side of the hull, by which the other one is found
/// (Shamos 1978, Computational Geometry, Yale University: rotating calipers).
[[nodiscard]] double smallestWidth(std::vector<Vec2> points);

}  // namespace yadefrag
