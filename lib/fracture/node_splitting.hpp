#pragma once
// What cracks do to the mesh: the fan of each node at their ends is cut, and every part of it but
// one gets a node of its own. Mass, momentum and centre stay what they were.

#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"
#include "surface/relink.hpp"

namespace yadefrag {

/// Everything that changed, so that all arrays by node or triangle can follow.
struct SplitResult {
  std::vector<ElementId> changed;  ///< triangles with a new node, ascending
  std::vector<NodeId> originals;   ///< of each new node, in order: the one it was part of
  std::vector<SurfaceSide> sides;  ///< all boundary sides at nodes that split or came to light
  std::vector<NodeId> onSurface;   ///< old nodes that were inside before, and are not any more
};

/// Cracks the edges (ascending, none of them cracked before). An edge both of whose ends are still
/// one node shows no faces: a crack of a single edge inside is shut by the mesh around it.
void splitNodes(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                std::span<const EdgeId> cracks, SplitResult& result);

}  // namespace yadefrag
