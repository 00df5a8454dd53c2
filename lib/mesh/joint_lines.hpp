#pragma once
// A polygon's edges and the joints in it, cut where they meet.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/size_field.hpp"
#include "mesh/triangle_mesh.hpp"

namespace yadefrag {

struct CutLines {
  /// A place on a loop, and the vertex at which its edge begins.
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

/// `polygon` as checkPolygon returns it. Joints may cross each other and the polygon's edges; what
/// is outside, or lies on an edge, is left out, and of what lies on an earlier joint the same. Ends
/// and crossings that are nearer to each other or to a line than tolerance::kJointMeets of the size
/// there are taken as meeting. InputError for a joint of which nothing is left, and for ends that
/// are not finite.
[[nodiscard]] CutLines cutAtJoints(const Polygon& polygon, const JointLines& joints,
                                   const SizeField& size);

}  // namespace yadefrag
