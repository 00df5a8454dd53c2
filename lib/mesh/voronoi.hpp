#pragma once
// Grains that fill a polygon.

#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// The Voronoi cells of `count` random places in the outline, clipped to it: the outlines of the
/// grains, counter-clockwise. Where the outline is not convex a cell may give several. Neighbours
/// have the same bits at their common vertices: all is exact until the last rounding. `rounds` of
/// Lloyd (1982, IEEE Trans. Inf. Theory 28, 129), which move the places to the middles of their
/// cells, make the grains even. The same seed gives the same bits. InputError as
/// checkPolygon, and for an outline so thin, or so far from the origin, that there are no `count`
/// places in it.
[[nodiscard]] std::vector<std::vector<Vec2>> voronoiGrains(const std::vector<Vec2>& outline,
                                                           std::uint32_t count, std::uint64_t seed,
                                                           int rounds = 0);

/// The grains with sides below `shortest` (m) shrunk to a point, as long as there are any that are
/// no sides of the outline: Voronoi cells have sides of any length, and a mesh would have triangles
/// as small. Grains that shrink to a point or a line are gone, the others fill the outline as
/// before. InputError where they could not, or more than half of them would be
/// gone.
[[nodiscard]] std::vector<std::vector<Vec2>> withoutShortSides(
    std::vector<std::vector<Vec2>> grains, const std::vector<Vec2>& outline, double shortest);

}  // namespace yadefrag
