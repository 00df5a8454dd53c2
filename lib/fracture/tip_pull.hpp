#pragma once
// What an edge transmits at the tip of a notch or a crack. The stress averaged around such a node
// takes in what lies behind it, and an edge would give way much too late: a notched beam with four
// elements in a cohesive zone would bear 37 to 53 % too much, by the pull it bears 2 to 9 %.

#include <span>

#include "fracture/crack_edges.hpp"

namespace yadefrag {

/// Do the triangles around a node of the boundary fill so much more than half of its surroundings
/// that it is a tip. `fan`: all of them, counter-clockwise.
[[nodiscard]] bool isTip(const Model& model, std::span<const ElementId> fan, NodeId node);

/// (Pa) How hard the triangles on either side of an edge pull at the tip where it ends, by the
/// forces of their present stress, when both sides move alike; along `normal` (out of the edge's
/// first triangle). They act on half of the edge, and on half of the crack that ends there, which
/// will hold, too. The pull alone: with the shear, cracks in mode II ran on ahead (Kalthoff: at 30
/// to 42°).
[[nodiscard]] double tipPull(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId tip,
                             std::span<const ElementId> fan, Vec2 normal);

}  // namespace yadefrag
