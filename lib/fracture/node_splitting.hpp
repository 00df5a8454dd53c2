#pragma once
// Changes of the mesh by cracks: the fan of each node at a crack's end is cut, and all its parts
// except one get a new node. Mass, momentum and centre of mass do not change.

#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

/// All changes, from which the arrays by node or triangle are updated.
struct SplitResult {
  std::vector<ElementId> changed;  ///< triangles with a new node, ascending
  std::vector<NodeId> originals;   ///< of each new node, in order: the node from which it was split
  /// All boundary sides at nodes that split or are new on the boundary.
  std::vector<SurfaceSide> sides;
  std::vector<NodeId> onSurface;  ///< old nodes that were inside before and are now on the boundary
};

/// Cracks the edges (ascending, none of them cracked before). An edge whose two ends both remain
/// one node has no visible faces: the mesh around a crack of a single inner edge keeps it closed.
void splitNodes(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                std::span<const EdgeId> cracks, SplitResult& result);

}  // namespace yadefrag
