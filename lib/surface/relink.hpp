#pragma once
// Contact surfaces after cracks: nodes have doubled, and edges inside have become faces.
//
//   before   ⌒⌒ H ⌒⌒ n ⌒⌒ H ⌒⌒         an arc around the smooth node n
//   after    ⌒⌒ H ─── n        n'─── H ⌒⌒   the arc's entry is now the second half of its segment,
//                     │        │            a first half is added to the segment after it; the
//                     └─ ─ ─ ─ ┘            crack's faces are added between them, straight
//
// A segment that was between two smooth nodes and is between two corners now is two entries, a
// first and a second half: a piece's number is for ever, and where it begins stays, too.

#include <span>
#include <vector>

#include "core/ids.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// A side of a triangle on the boundary: material on the left.
struct SurfaceSide {
  SegmentId segment;   ///< the segment it was before; none(): a new face
  NodeId first, last;  ///< its nodes now
  ComponentId component;
};

/// Brings up to date all segments whose nodes changed and adds new ones, in the order given.
/// `sides`: every boundary side, once, that begins or ends at a node that was split, that changed
/// its number, or that newly lies on the boundary. At each boundary node one side begins and one
/// ends. Nodes where a new face begins or ends or whose number changed become corners. Segments and
/// entries are only appended: new ones are [entries() before, entries() after). Of the others an
/// arc may become the second half of its segment, and links change; nothing else does.
///
/// `ContactSurfaces::loop` stays the loop in which a piece was made; a new face takes that of the
/// pieces before it, or, if its closed list is all new, its component's lowest. Cyclic lists that
/// join or part keep theirs: from then on a list may hold several, and one be in several lists.
///
/// Returns the arcs that became second halves, in no order. At a convex node the corner stands out
/// of the arc that was there, by 5/32 of |a − 2b + c|: what touched the arc is inside the body
/// now, so what is known of slaves outside has to be found anew.
///
/// Cost ~ sides.size(); a closed list that is all new looks for its component's first entry.
std::vector<EntryId> relink(ContactSurfaces& surfaces, std::span<const SurfaceSide> sides);

}  // namespace yadefrag
