#pragma once
// Moves boundary nodes and divides boundary sides, with the triangles behind them: all data by node
// and triangle follow, and no triangle's deformation gradient changes.

#include <span>
#include <vector>

#include "fracture/conform.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

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
