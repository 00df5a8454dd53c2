#pragma once
// A polygon's edges and its joints, cut at their intersections.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/size_field.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

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
};

/// `polygon` must be a result of checkPolygon. Joints may cross each other and the polygon's edges.
/// Parts of a joint outside the polygon, on an edge, or on an earlier joint are removed. Two ends
/// or intersections, or an end and a line, that are nearer than tolerance::kJointMeets of the local
/// size count as meeting. Throws InputError for a joint without a remaining part, and for ends that
/// are not finite.
[[nodiscard]] CutLines cutAtJoints(const Polygon& polygon, const JointLines& joints,
                                   const SizeField& size);

}  // namespace yadefrag
