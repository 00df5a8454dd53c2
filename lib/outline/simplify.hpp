#pragma once
// Simplifies outlines with far more points than their shape needs, such as contours of pixels.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The vertices that are sufficient for the shape of the polygon: for each loop, the outline first,
/// their numbers, ascending. A removed vertex is at most `tolerance` (m) away from the edge that
/// replaces it. No edges cross or touch, and holes stay inside: vertices needed for that are kept.
/// Also kept are vertex 0 of each loop, and each vertex of the outline with a mark in `pinned`
/// (empty: none). The others are removed in order of increasing distance (Dyken, Dæhlen and
/// Sevaldrud 2009, J. Geogr. Syst. 11, 273). Throws InputError as checkPolygon, for a tolerance
/// that is not positive and finite, and for a tolerance of at least a loop's area over its length,
/// with which the loop could vanish.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> verticesToKeep(
    const Polygon& polygon, double tolerance, std::span<const std::uint8_t> pinned = {});

}  // namespace yadefrag
