#pragma once
// The stages of `triangulate`.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "meshing/joint_lines.hpp"
#include "meshing/size_field.hpp"

namespace yadefrag {

// --- The loops and joints of a polygon, with long edges divided: they give all nodes of the mesh
// that must not be moved.

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

// --- The stages of `triangulate` after the boundary has been divided: nodes inside, triangles
// between all nodes, better triangles.

/// A mesh under construction: each triangle stores its neighbours.
struct LinkedTriangles {
  static constexpr std::uint32_t kNone = 0xffffffff;
  using Three = std::array<std::uint32_t, 3>;

  std::vector<Vec2> nodes;        ///< m
  std::uint32_t numBoundary = 0;  ///< number of boundary nodes; these come first and must not move
  std::vector<Three> triangles;   ///< counter-clockwise
  /// Neighbour across the side opposite to each node, or kNone: on the boundary, and on joints,
  /// whose sides must not be flipped.
  std::vector<Three> neighbours;

  [[nodiscard]] Vec2 at(std::uint32_t triangle, int corner) const {
    return nodes[triangles[triangle][corner]];
  }

  /// The corner of `triangle` opposite to its side to `neighbour`.
  [[nodiscard]] int cornerAcross(std::uint32_t triangle, std::uint32_t neighbour) const {
    const Three& n = neighbours[triangle];
    return n[0] == neighbour ? 0 : n[1] == neighbour ? 1 : 2;
  }
  [[nodiscard]] int cornerOf(std::uint32_t triangle, std::uint32_t node) const {
    const Three& t = triangles[triangle];
    return t[0] == node ? 0 : t[1] == node ? 1 : 2;
  }
};

/// Positions of the nodes inside a body, by an advancing front: nodes are added from the boundary
/// inwards until the fronts meet. They are placed at the corners of nearly equilateral triangles,
/// or at random points where the Poisson disks around all nodes leave room (Bridson 2007; a maximal
/// sampling, Ebeida et al. 2011, except for gaps that 30 tries missed). A few may be outside where
/// the boundary is finer than its surroundings.
[[nodiscard]] std::vector<Vec2> fillInterior(const DividedBoundary& boundary, const SizeField& size,
                                             MeshLayout layout = {});

/// The constrained Delaunay triangulation: all triangles between the loops of a boundary. Joints
/// become sides of triangles. A point of `inside` becomes a node only if it is strictly inside. The
/// nodes are those of the boundary, in their order, then the used points of `inside`. Throws
/// InputError if the division of the edges made loops meet.
[[nodiscard]] LinkedTriangles triangulateNodes(const DividedBoundary& boundary,
                                               std::span<const Vec2> inside);

/// Moves inner nodes and flips inner edges until the triangles are Delaunay again and their
/// smallest angles have grown. With `evenHeights` it also increases the smallest heights, on which
/// the time step depends: with scattered nodes some triangles are far smaller than their
/// neighbours.
void improve(LinkedTriangles& mesh, bool evenHeights = false);

// --- Numbering along the Lebesgue curve: points that are near in the plane are near in memory.

/// The indices of the points in their order along the curve; points with the same code keep their
/// order. The curve's grid has 2^20 boxes along the longer side of the bounding box.
[[nodiscard]] std::vector<std::uint32_t> orderAlongCurve(std::span<const Vec2> points);

/// Renumbers the nodes by position and the triangles by centroid. Each triangle then begins with
/// its lowest node, each loop, too. Returns the former number of each node.
std::vector<std::uint32_t> numberAlongCurve(TriangleMesh& mesh);

}  // namespace yadefrag
