#pragma once
// The mesh of one body, before it is added to the model.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

/// An outline and its holes; after `checkPolygon` the outline is counter-clockwise, holes
/// clockwise.
struct Polygon {
  std::vector<Vec2> outline;
  std::vector<std::vector<Vec2>> holes;
};

/// Ends (m) of straight lines on which sides of triangles must lie.
using JointLines = std::vector<std::array<Vec2, 2>>;

/// Arrangement of the nodes inside a body.
enum class NodeLayout : std::uint8_t {
  kRows,       ///< rows along the boundary: nearly equilateral triangles, edges in few directions
  kScattered,  ///< random with a minimum distance: edges in all directions
};

struct MeshLayout {
  NodeLayout nodes = NodeLayout::kRows;
  std::uint64_t seed = 0;  ///< of the random positions
};

/// Node and triangle numbers follow the Lebesgue curve: neighbours are near in memory.
struct TriangleMesh {
  std::vector<Vec2> nodes;                              ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
  /// Boundary nodes in order, material on the left: first the outline, then the holes in the given
  /// order.
  std::vector<std::vector<std::uint32_t>> loops;
  /// For each boundary node its vertex number in the outline or hole; for a node that divides a
  /// long edge, the number of the vertex at which that edge begins.
  std::vector<std::vector<std::uint32_t>> loopVertices;
  /// Sides of triangles on joints: both nodes, and the number of the joint.
  std::vector<std::array<std::uint32_t, 3>> joints;
  double minAngle = 0;  ///< rad, smallest angle of all triangles
};

}  // namespace yadefrag
