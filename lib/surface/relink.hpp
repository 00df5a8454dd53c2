#pragma once
// Contact surfaces after cracks: nodes have doubled, and edges inside have become faces.
//
//   before   ⌒⌒ H ⌒⌒ n ⌒⌒ H ⌒⌒         an arc around the smooth node n
//   after    ⌒⌒ H ─── n        n'─── H ⌒⌒   the arc's entry is now the second half of its segment,
//                     │        │            a first half is added to the segment after it; the
//                     └─ ─ ─ ─ ┘            crack's faces are added between them, straight
//
// A segment that was between two smooth nodes and is now between two corners has two entries, a
// first and a second half: the number of a piece and the point at which it begins never change.

#include <span>
#include <vector>

#include "core/ids.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// A side of a triangle on the boundary, material on the left.
struct SurfaceSide {
  SegmentId segment;   ///< its former segment; none(): a new face
  NodeId first, last;  ///< its present nodes
  ComponentId component;
};

/// Updates all segments whose nodes changed and adds new ones, in the given order. `sides`: every
/// boundary side, once, that begins or ends at a node that was split, that changed its number, or
/// that is new on the boundary. At each boundary node one side begins and one ends. Nodes where a
/// new face begins or ends, and nodes whose number changed, become corners. Segments and entries
/// are only appended: new ones are [entries() before, entries() after). Of the old ones an arc may
/// become the second half of its segment, and links change; nothing else changes.
///
/// `ContactSurfaces::loop` remains the loop in which a piece was created. A new face takes the loop
/// of the pieces before it or, if its closed list is all new, its component's lowest. When cyclic
/// lists join or separate, their pieces keep their loops: a list may then contain several loops,
/// and a loop may be in several lists.
///
/// Returns the arcs that became second halves, in no order. At a convex node the corner protrudes
/// from the former arc by 5/32 of |a − 2b + c|: points that touched the arc are now inside the
/// body, so that the stored slaves outside must be determined again.
///
/// Cost ~ sides.size(); a closed list of new faces only needs a search for its component's first
/// entry.
std::vector<EntryId> relink(ContactSurfaces& surfaces, std::span<const SurfaceSide> sides);

}  // namespace yadefrag
