#include "surface/contact_surface.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/arrays.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {
namespace {

/// New numbers of the rows that are kept, in order; none() for removed rows.
template <class IdType, class Stays>
std::vector<IdType> compactNumbers(std::size_t count, Stays stays) {
  std::vector<IdType> numbers(count, IdType::none());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (stays(i)) numbers[i] = IdType(kept++);
  return numbers;
}

template <class IdType>
void translate(std::vector<IdType>& links, const std::vector<IdType>& numbers) {
  for (IdType& link : links) link = numbers[link.value];
}

Stencil onSegment(NodeId a, NodeId b, double xi) { return {{a, b, {}}, {1 - xi, xi, 0}, 2}; }

/// Appends the segments of a closed loop, without entries.
void appendSegments(ContactSurfaces& s, std::span<const NodeId> nodes,
                    std::span<const std::uint8_t> smooth) {
  const std::size_t first = s.segments();
  const std::size_t count = nodes.size();
  const auto last = std::max_element(nodes.begin(), nodes.end());
  if (last->value >= s.nodeSegment.size()) s.nodeSegment.resize(last->value + 1, SegmentId::none());
  resizeRows(s.segmentColumns(), first + count);
  for (std::size_t i = 0; i < count; ++i) {
    assert(s.nodeSegment[nodes[i].value] == SegmentId::none());
    s.nodeSegment[nodes[i].value] = SegmentId(first + i);
    s.segmentNode[first + i] = nodes[i];
    s.segmentNext[first + i] = SegmentId(first + (i + 1) % count);
    s.segmentPrev[first + i] = SegmentId(first + (i + count - 1) % count);
    s.segmentEntry[first + i] = EntryId::none();
  }
  const auto isSmooth = [](std::uint8_t flag) { return flag != 0; };
  if (!s.anySmooth() && std::ranges::none_of(smooth, isSmooth)) return;
  s.segmentSmooth.resize(first + count);
  for (std::size_t i = 0; i < count; ++i) s.segmentSmooth[first + i] = isSmooth(smooth[i]) ? 1 : 0;
}

}  // namespace

std::uint32_t ContactSurfaces::addLoop(std::span<const NodeId> nodes,
                                       std::span<const std::uint8_t> smooth, ComponentId owner) {
  assert(nodes.size() >= 2 && smooth.size() == nodes.size());
  const std::uint32_t number = loop.empty() ? 0 : *std::max_element(loop.begin(), loop.end()) + 1;
  const std::size_t firstSegment = segments();
  const std::size_t firstEntry = entries();
  appendSegments(*this, nodes, smooth);

  const auto append = [&](std::size_t segment, Piece kind) {
    if (segmentEntry[segment] == EntryId::none()) segmentEntry[segment] = EntryId(entries());
    entrySegment.push_back(SegmentId(segment));
    piece.push_back(kind);
  };
  for (std::size_t s = firstSegment; s < segments(); ++s) {
    const bool fromSmooth = isSmooth(SegmentId(s));
    const bool toSmooth = isSmooth(segmentNext[s]);
    if (!fromSmooth) append(s, toSmooth ? Piece::kFirstHalf : Piece::kSegment);
    if (toSmooth)
      append(s, Piece::kArc);
    else if (fromSmooth)
      append(s, Piece::kSecondHalf);
  }

  const std::size_t count = entries() - firstEntry;
  resizeRows(entryColumns(), entries());
  for (std::size_t i = 0; i < count; ++i) {
    next[firstEntry + i] = EntryId(firstEntry + (i + 1) % count);
    prev[firstEntry + i] = EntryId(firstEntry + (i + count - 1) % count);
    loop[firstEntry + i] = number;
    component[firstEntry + i] = owner;
  }
  return number;
}

auto ContactSurfaces::removeComponents(const std::vector<std::uint8_t>& gone) -> Numbers {
  const auto stays = [&](EntryId entry) { return gone[component[entry.value].value] == 0; };
  auto segmentNumbers =
      compactNumbers<SegmentId>(segments(), [&](std::size_t s) { return stays(segmentEntry[s]); });
  auto entryNumbers =
      compactNumbers<EntryId>(entries(), [&](std::size_t e) { return stays(EntryId(e)); });

  for (SegmentId& segment : nodeSegment)
    if (segment != SegmentId::none()) segment = segmentNumbers[segment.value];
  keepRows(segmentColumns(), segments(),
           [&](std::size_t s) { return segmentNumbers[s] != SegmentId::none(); });
  keepRows(entryColumns(), entries(),
           [&](std::size_t e) { return entryNumbers[e] != EntryId::none(); });

  translate(segmentNext, segmentNumbers);
  translate(segmentPrev, segmentNumbers);
  translate(entrySegment, segmentNumbers);
  translate(segmentEntry, entryNumbers);
  translate(next, entryNumbers);
  translate(prev, entryNumbers);

  // Numbers of loops are kept without gaps, too.
  std::vector<std::uint32_t> remaining(loop);
  sortUnique(remaining);
  for (std::uint32_t& number : loop)
    number = static_cast<std::uint32_t>(
        std::lower_bound(remaining.begin(), remaining.end(), number) - remaining.begin());
  return {std::move(segmentNumbers), std::move(entryNumbers)};
}

void ContactSurfaces::drop(std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) {
    if (node.value >= nodeSegment.size() || nodeSegment[node.value] == SegmentId::none()) continue;
    const SegmentId segment = nodeSegment[node.value];
    EntryId entry = segmentEntry[segment.value];
    for (; entrySegment[entry.value] == segment; entry = next[entry.value])
      piece[entry.value] = Piece::kGone;
  }
}

void ContactSurfaces::renumberNodes(std::span<const NodeId> renumbered, std::size_t nodeCount) {
  nodeSegment.assign(nodeCount, SegmentId::none());
  for (std::size_t s = 0; s < segments(); ++s) {
    segmentNode[s] = renumbered[segmentNode[s].value];
    assert(segmentNode[s].value < nodeCount);  // a node of a loop must not be removed
    nodeSegment[segmentNode[s].value] = SegmentId(s);
  }
}

int ContactSurfaces::pieceNodes(EntryId entry, NodeId (&nodes)[3]) const {
  const SegmentId segment = entrySegment[entry.value];
  const SegmentId following = segmentNext[segment.value];
  nodes[0] = segmentNode[segment.value];
  nodes[1] = segmentNode[following.value];
  if (piece[entry.value] != Piece::kArc) return 2;
  nodes[2] = segmentNode[segmentNext[following.value].value];
  return 3;
}

Stencil ContactSurfaces::slave(EntryId entry) const {
  const SegmentId segment = entrySegment[entry.value];
  const NodeId a = segmentNode[segment.value];
  const Piece kind = piece[entry.value];
  if (kind == Piece::kSegment || kind == Piece::kFirstHalf) return {{a, {}, {}}, {1, 0, 0}, 1};
  return onSegment(a, segmentNode[segmentNext[segment.value].value], .5);
}

Stencil ContactSurfaces::master(EntryId entry, double xi) const {
  NodeId nodes[3];
  if (pieceNodes(entry, nodes) == 2) return onSegment(nodes[0], nodes[1], xi);
  const ArcWeights h = arcShape(xi);
  return {{nodes[0], nodes[1], nodes[2]}, {h[0], h[1], h[2]}, 3};
}

}  // namespace yadefrag
