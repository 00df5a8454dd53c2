#pragma once
// A polygon's edges and its joints, cut at their intersections.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "meshing/size_field.hpp"

namespace yadefrag {

/// What has been joined by a tolerance.
struct JoinedTraces {
  std::size_t count = 0;  ///< places: ends, intersections, and points to which other lines bend
  double farthest = 0;    ///< m, largest displacement
};

struct CutLines {
  /// A point on a loop, and the vertex at which its edge begins.
  struct Corner {
    std::uint32_t point;
    std::uint32_t vertex;
  };
  /// A part of a joint, from one point to the next.
  struct Piece {
    std::array<std::uint32_t, 2> points;
    std::uint32_t joint;
  };

  std::vector<Vec2> points;                ///< m
  std::vector<std::vector<Corner>> loops;  ///< the outline, then the holes
  std::vector<Piece> pieces;               ///< in the order of the joints
  JoinedTraces joined;
};

/// `polygon` must be a result of checkPolygon. Joints may cross each other and the polygon's edges.
/// Parts of a joint outside the polygon, on an edge, or on an earlier joint are removed. Ends and
/// intersections, and lines, that are nearer to each other than `tolerance` (m; at least
/// tolerance::kJointMeets of the local size) are joined: joints end at, and bend to, common points.
/// Edges of the polygon keep their places. Throws InputError for a joint without a remaining part,
/// and for ends that are not finite.
[[nodiscard]] CutLines cutAtJoints(const Polygon& polygon, const JointLines& joints,
                                   const SizeField& size, double tolerance = 0);

}  // namespace yadefrag
