#pragma once
// Divides a polygon into grains.

#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The Voronoi cells of `count` random points in the outline, clipped to it: the outlines of the
/// grains, counter-clockwise. If the outline is not convex a cell may give several grains. Common
/// vertices of neighbours have the same bits: all computations are exact until the last rounding.
/// `rounds` of Lloyd's iteration (1982, IEEE Trans. Inf. Theory 28, 129), which moves the points to
/// the centroids of their cells, make the grains more even. The same seed gives the same bits.
/// Throws InputError as checkPolygon, and for an outline so thin, or so far from the origin, that
/// `count` points inside it are not found.
[[nodiscard]] std::vector<std::vector<Vec2>> voronoiGrains(const std::vector<Vec2>& outline,
                                                           std::uint32_t count, std::uint64_t seed,
                                                           int rounds = 0);

/// The grains with their short sides removed: each side below `shortest` (m) that is not on the
/// outline is shrunk to a point, until there is none left. Reason: Voronoi cells have sides of any
/// length, and a mesh would have triangles as small. Grains that shrink to a point or a line are
/// removed; the others fill the outline as before. Throws InputError if they cannot, or if more
/// than half of the grains would be removed.
[[nodiscard]] std::vector<std::vector<Vec2>> withoutShortSides(
    std::vector<std::vector<Vec2>> grains, const std::vector<Vec2>& outline, double shortest);

}  // namespace yadefrag
