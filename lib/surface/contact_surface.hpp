#pragma once
// The two layers of a boundary (paper §3.1): the mesh's boundary segments, and above them the
// contact surface ("virtual surface") with one entry for each sampling point.
//
//   mesh       a ───────── b ───────── c ─────     segments, one per boundary node
//   contact    a ───────── b ─── H ⌒⌒⌒ H ⌒⌒     entries: a, b corners; c, … smooth; H a halfpoint
//
// A node is a corner (straight) or smooth. Between two corners the curve is the segment; around a
// smooth node it is the Bézier arc from the halfpoint before to the halfpoint after; between a
// corner and a halfpoint it is half the segment. Every entry is a slave (its sampling point, where
// the piece begins) and a master (the piece up to the next entry's sampling point).
//
// Where a smooth node cracks it becomes a corner and its arc two halves (relink, below): a segment
// between two corners is one entry, or a first and a second half.

#include <cstdint>
#include <span>
#include <vector>

#include "core/columns.hpp"
#include "core/ids.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

enum class Piece : std::uint8_t {
  kSegment,     ///< nodes a, b; whole segment: 0 ≤ ξ ≤ 1
  kFirstHalf,   ///< of a segment that begins at a corner: 0 ≤ ξ ≤ ½
  kSecondHalf,  ///< of a segment that ends at a corner: ½ ≤ ξ ≤ 1
  kArc,         ///< nodes a, b, c; from the halfpoint of ab (ξ = 0) to that of bc (ξ = 1)
  kGone,        ///< of a removed fragment: it keeps its number, and has no contact
};

/// A point of the boundary as a linear combination of up to three nodes; unused ones have weight 0.
struct Stencil {
  NodeId node[3];
  double weight[3] = {1, 0, 0};
  int count = 1;
};

class ContactSurfaces {
 public:
  /// Adds a closed loop, material on the left, with one `smooth` flag per node. Returns the number
  /// of the loop. Two nodes are a line with two sides.
  std::uint32_t addLoop(std::span<const NodeId> nodes, std::span<const std::uint8_t> smooth,
                        ComponentId component);
  /// New numbers of segments and entries; none() of removed ones.
  struct Numbers {
    std::vector<SegmentId> segments;
    std::vector<EntryId> entries;
  };
  /// Removes all loops of the components with a mark in `gone`; later entries move up, in order.
  Numbers removeComponents(const std::vector<std::uint8_t>& gone);
  /// Marks all pieces that begin at or after these nodes as removed; the nodes must be whole loops.
  void drop(std::span<const NodeId> nodes);
  /// Changes node numbers: `renumbered[old]` is the new number, none() for a removed node.
  void renumberNodes(std::span<const NodeId> renumbered, std::size_t nodeCount);

  // First layer: segment s runs from segmentNode[s] to that of the next one.
  std::vector<NodeId> segmentNode;
  std::vector<SegmentId> segmentNext, segmentPrev;
  /// True if its first node is smooth; empty: no smooth node so far.
  std::vector<std::uint8_t> segmentSmooth;
  std::vector<EntryId> segmentEntry;   ///< its first entry: at its first node or halfpoint
  std::vector<SegmentId> nodeSegment;  ///< by node: the segment that begins there, or none()

  // Second layer.
  std::vector<SegmentId> entrySegment;  ///< the segment in which it begins
  std::vector<Piece> piece;
  std::vector<EntryId> next, prev;
  /// Number of the loop in which the entry was created; single passing distinguishes surfaces by
  /// it. After a crack the closed lists differ from these loops: they are given by `next` and
  /// `segmentNext`.
  std::vector<std::uint32_t> loop;
  std::vector<ComponentId> component;

  /// All arrays by segment (core/columns.hpp), in the order of saved states.
  template <class Self>
  static auto segmentColumnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"segmentNode"}, self.segmentNode);
      visit(Column{"segmentNext"}, self.segmentNext);
      visit(Column{"segmentPrev"}, self.segmentPrev);
      visit(Column{"segmentSmooth", kOptional}, self.segmentSmooth);
      visit(Column{"segmentEntry"}, self.segmentEntry);
    };
  }
  auto segmentColumns() { return segmentColumnsOf(*this); }
  auto segmentColumns() const { return segmentColumnsOf(*this); }

  /// All arrays by entry, likewise.
  template <class Self>
  static auto entryColumnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"entrySegment"}, self.entrySegment);
      visit(Column{"piece"}, self.piece);
      visit(Column{"next"}, self.next);
      visit(Column{"prev"}, self.prev);
      visit(Column{"loop"}, self.loop);
      visit(Column{"entryComponent"}, self.component);
    };
  }
  auto entryColumns() { return entryColumnsOf(*this); }
  auto entryColumns() const { return entryColumnsOf(*this); }

  [[nodiscard]] bool anySmooth() const { return !segmentSmooth.empty(); }
  [[nodiscard]] bool isSmooth(SegmentId segment) const {
    return anySmooth() && segmentSmooth[segment.value] != 0;
  }
  [[nodiscard]] std::size_t segments() const { return segmentNode.size(); }
  [[nodiscard]] bool isGone(EntryId entry) const { return piece[entry.value] == Piece::kGone; }
  [[nodiscard]] bool isGone(SegmentId segment) const { return isGone(segmentEntry[segment.value]); }
  [[nodiscard]] std::size_t entries() const { return entrySegment.size(); }

  /// First node of the segment in which an entry begins.
  [[nodiscard]] NodeId nodeOf(EntryId entry) const {
    return segmentNode[entrySegment[entry.value].value];
  }
  /// Up to three nodes a, b, c of a piece; returns their number.
  int pieceNodes(EntryId entry, NodeId (&nodes)[3]) const;
  /// The sampling point of an entry: a node or a halfpoint.
  [[nodiscard]] Stencil slave(EntryId entry) const;
  /// The point ξ of an entry's piece (eq. 1, eq. 2).
  [[nodiscard]] Stencil master(EntryId entry, double xi) const;
};

// --- Contact surfaces after cracks: nodes have doubled, and edges inside have become faces.
//
//   before   ⌒⌒ H ⌒⌒ n ⌒⌒ H ⌒⌒         an arc around the smooth node n
//   after    ⌒⌒ H ─── n        n'─── H ⌒⌒   the arc's entry is now the second half of its segment,
//                     │        │            a first half is added to the segment after it; the
//                     └─ ─ ─ ─ ┘            crack's faces are added between them, straight
//
// A segment that was between two smooth nodes and is now between two corners has two entries, a
// first and a second half: the number of a piece and the point at which it begins never change.

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
