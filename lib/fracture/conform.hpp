#pragma once
// Sides of two bodies that run along each other with different ends get the same ends, so that they
// can be bonded:
//
//   body a   ──o────────o────────o──      nodes near each other: one slides along its own side
//   body b   ───o────o────o────o────      onto the other; each of the rest divides the side
//                                         opposite it, and the triangle behind that side.

#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

struct NodeMove {
  NodeId node;
  Vec2 to;  ///< m
};

/// A new node on a boundary side.
struct NewNode {
  Side side;
  double part;  ///< of the side's length, from its begin
  Vec2 at;      ///< m
};

struct ConformPlan {
  std::vector<NodeMove> moves;    ///< by node
  std::vector<NewNode> newNodes;  ///< by side, then by part
  std::size_t corners = 0;        ///< moves of corners by more than `reach`
  double farthest = 0;            ///< m, of these

  [[nodiscard]] bool isEmpty() const { return moves.empty() && newNodes.empty(); }
};

/// Nodes slide by up to kSlide of a side, and corners of outlines are joined if they are nearer
/// than kJoinedCorners of a side, or `reach` (m; 0: kProbableBond of a side), which is also the
/// widest gap. Nodes at bonds and faces of cracks do not move.
[[nodiscard]] ConformPlan planConforming(const Model& model, const CrackEdges& edges,
                                         std::span<const ComponentId> bodies, double reach);

// --- Moves boundary nodes and divides boundary sides, with the triangles behind them: all data by
// node and triangle follow, and no triangle's deformation gradient changes.

/// The boundary after sides were divided, for `relink` and for loads on segments.
struct DividedSides {
  std::vector<SurfaceSide> sides;
  std::vector<SegmentId> parents;  ///< by new segment, in order: the one that was divided
};

/// Positions (present and stress-free) and velocities of moved and new nodes are those of the
/// triangles there; new nodes are held as both ends of their side are. New triangles follow those
/// of their body, so that triangles of later bodies get higher numbers. The mass of a body changes
/// only with its area.
DividedSides conform(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                     const ConformPlan& plan);

}  // namespace yadefrag
