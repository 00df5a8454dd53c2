#pragma once
// Outlines with far more points than their shape needs, such as contours of pixels.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Which vertices of the polygon are enough for its shape: for each loop, the outline first, their
/// numbers, ascending. A vertex that is left out is at most `tolerance` (m) away from the edge that
/// takes its place. No edges cross or touch, and holes stay inside: vertices that this needs stay
/// too. So does vertex 0 of each loop, and each vertex of the outline with a mark in `pinned`
/// (empty: none). The rest by increasing distance (Dyken, Dæhlen and Sevaldrud 2009, J. Geogr.
/// Syst. 11, 273). InputError as checkPolygon, for a tolerance that is not positive and finite, and
/// for one that could make a loop vanish: as large as the loop's area over its length.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> verticesToKeep(
    const Polygon& polygon, double tolerance, std::span<const std::uint8_t> pinned = {});

}  // namespace yadefrag
