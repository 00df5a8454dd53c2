#pragma once
// The loops and joints of a polygon, with long edges divided: they give all nodes of the mesh that
// must not be moved.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "meshing/joint_lines.hpp"
#include "meshing/size_field.hpp"

namespace yadefrag {

struct DividedBoundary {
  std::vector<Vec2> nodes;  ///< m, loop by loop, material on the left; then those on joints
  std::vector<Vec2> given;  ///< m, the same, also where triangulate has scaled and rounded `nodes`
  std::vector<std::uint32_t> first;   ///< first node of each loop, and one past the last
  std::vector<std::uint32_t> vertex;  ///< vertex of each loop node, see TriangleMesh::loopVertices
  std::vector<std::array<std::uint32_t, 3>> joints;  ///< see TriangleMesh
  JoinedTraces joined;

  [[nodiscard]] std::size_t numLoops() const { return first.size() - 1; }

  /// Calls `visit(begin, end)` for each edge of the loops.
  template <class Visit>
  void forEachEdge(Visit visit) const {
    for (std::size_t loop = 0; loop + 1 < first.size(); ++loop)
      for (std::uint32_t i = first[loop]; i < first[loop + 1]; ++i)
        visit(i, i + 1 == first[loop + 1] ? first[loop] : i + 1);
  }
};

/// Checks `given` and divides each edge into round(length/size) equal parts, at least one. If the
/// size varies, the parts have the local size, all multiplied by one factor. Vertex numbers are
/// those of `given`. Joints are divided in the same way. Throws InputError as checkPolygon and
/// cutAtJoints, and for a size that is not positive and finite, or too small for 32-bit numbers,
/// for the rounding of the coordinates, or for `mostBytes` of memory.
[[nodiscard]] DividedBoundary divideBoundary(const Polygon& given, const SizeField& size,
                                             double mostBytes = INFINITY,
                                             const JointLines& joints = {},
                                             double jointTolerance = 0);

}  // namespace yadefrag
