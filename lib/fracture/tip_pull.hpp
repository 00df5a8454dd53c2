#pragma once
// Traction that an edge transmits at the tip of a notch or a crack. The stress averaged around such
// a node includes the unloaded material behind the tip, so that by this average an edge would crack
// far too late: a notched beam with four elements in the cohesive zone would carry 37 to 53 % too
// much load.

#include <span>

#include "fracture/crack_edges.hpp"
#include "fracture/separation.hpp"

namespace yadefrag {

/// True if the triangles around a boundary node fill an angle above kTipAngle, so that the node is
/// the tip of a notch or a crack. `fan`: all these triangles, counter-clockwise.
[[nodiscard]] bool isTip(const Model& model, std::span<const ElementId> fan, NodeId node);

/// Unit normal of an edge, outward from its first triangle.
[[nodiscard]] Vec2 normalOf(const Model& model, const CrackEdges& edges, EdgeId edge);

/// (Pa) Traction that holds the triangles on the two sides of an edge together at the tip where it
/// ends, from the forces of their present stress, if both sides move with the same acceleration. It
/// acts on half of the edge, and on half of the crack that ends there, which will be cohesive, too.
[[nodiscard]] Traction tipTraction(const Model& model, const CrackEdges& edges, EdgeId edge,
                                   NodeId tip, std::span<const ElementId> fan);

/// Largest pull at the tip of the other edges that end there, over their strength.
[[nodiscard]] double otherPull(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId tip,
                               std::span<const ElementId> fan);

}  // namespace yadefrag
