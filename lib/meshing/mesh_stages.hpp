#pragma once
// The stages of `triangulate` after the boundary has been divided: nodes inside, triangles between
// all nodes, better triangles.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/divided_boundary.hpp"

namespace yadefrag {

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

}  // namespace yadefrag
