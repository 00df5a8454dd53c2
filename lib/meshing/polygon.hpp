#pragma once
// Checks whether a polygon can be meshed.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec2.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

/// Returns the polygon with its outline counter-clockwise and its holes clockwise; a reversed loop
/// keeps its vertex 0 as the first. Throws InputError, which names the vertices, for fewer than
/// three points, values that are not finite, repeated points, zero area, edges that cross or touch,
/// holes outside the outline or inside another hole. All comparisons are exact.
[[nodiscard]] Polygon checkPolygon(Polygon polygon);

// --- Convex hull of points, and its smallest width.

/// Convex hull, counter-clockwise, without collinear or coincident points up to `rounding` (m).
[[nodiscard]] std::vector<Vec2> hullOf(std::vector<Vec2> points, double rounding);

/// (m) The least distance between two parallel lines with all the points between them; 0 if they
/// are on one line. One of the lines has a side of the hull, by which the other one is found
/// (Shamos 1978, Computational Geometry, Yale University: rotating calipers).
[[nodiscard]] double smallestWidth(std::vector<Vec2> points);

// --- Moves outlines onto their neighbours: rounded coordinates make gaps and overlaps between
// bodies that touch.

struct SnapRule {
  double tolerance = 0;  ///< m, largest distance of a vertex from what it is moved onto
  /// m: vertices of the neighbours that are nearer than this to a vertex of the outline are not
  /// inserted into it.
  double spacing = 0;
  /// True: all vertices of the neighbours along an edge become vertices of it, so that the meshes
  /// match node by node. False: only those that would be inside the outline.
  bool matchesNodes = true;
};

/// By vertex of a snapped loop: position (m); number of the given vertex, for an inserted one that
/// at which its edge begins.
struct SnappedLoop {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> vertex;
  std::vector<std::uint8_t> isInserted;
};

struct SnapCount {
  std::size_t moved = 0, inserted = 0;
  double farthest =
      0;  ///< m, largest displacement of a vertex, or of an edge by an inserted vertex

  SnapCount& operator+=(const SnapCount& other);
};

struct Snapped {
  std::vector<SnappedLoop> loops;  ///< the outline, then the holes
  SnapCount count;
};

/// Sides of the neighbours, with their material on the left; lines have two.
using SnapSides = std::vector<std::array<Vec2, 2>>;

/// Moves each vertex of the polygon within the tolerance of a neighbour onto its nearest vertex, or
/// else onto its nearest side, and inserts vertices of the neighbours into the polygon's edges
/// (T-junctions). The neighbours do not change. Where two vertices of the neighbours are nearer to
/// each other than `spacing`, the edge stays behind both. Throws InputError if the tolerance is not
/// positive and finite, or if a loop would collapse.
[[nodiscard]] Snapped snapOnto(const Polygon& polygon, const SnapSides& neighbours,
                               const SnapRule& rule);

/// Snaps polygons to each other in their order: each is moved onto the earlier ones, and gets the
/// vertices of all others on its edges. Common sides have the same ends afterwards.
[[nodiscard]] std::vector<Snapped> snapTogether(std::vector<Polygon> polygons, double tolerance);

}  // namespace yadefrag
