#include "step/crack_candidates.hpp"

#include <algorithm>
#include <cassert>

#include "core/sort_unique.hpp"
#include "search/overlapping_pairs.hpp"
#include "step/entry_pairs.hpp"

namespace yadefrag {
namespace {

/// Nodes that were one node before, including `original`.
struct Twin {
  NodeId original, node;
  friend auto operator<=>(const Twin&, const Twin&) = default;
};

std::vector<Twin> twinsOf(std::span<const NodeId> originals, std::size_t nodeCount) {
  std::vector<Twin> twins;
  const std::size_t firstNew = nodeCount - originals.size();
  for (std::size_t i = 0; i < originals.size(); ++i) {
    twins.push_back({originals[i], originals[i]});
    twins.push_back({originals[i], NodeId(firstNew + i)});
  }
  sortUnique(twins);
  return twins;
}

}  // namespace

std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, const Candidates& candidates,
                                   std::span<const SurfaceSide> sides) {
  std::vector<EntryId> own;
  for (const SurfaceSide& side : sides) {
    const EntryId entry = surfaces.segmentEntry[surfaces.nodeSegment[side.first.value].value];
    // A segment has two entries at most; with two steps back the previous segment is included.
    EntryId at = surfaces.prev[surfaces.prev[entry.value].value];
    for (int k = 0; k < 6; ++k, at = surfaces.next[at.value]) own.push_back(at);
  }
  sortUnique(own);
  const auto isOwn = [&](EntryId entry) {
    return std::binary_search(own.begin(), own.end(), entry);
  };
  std::vector<EntryId> around(own);
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r) {
    const bool ownSlave = isOwn(candidates.slaves[r]);
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      if (ownSlave) around.push_back(candidates.masters[c]);
      if (isOwn(candidates.masters[c])) around.push_back(candidates.slaves[r]);
    }
  }
  sortUnique(around);
  return around;
}

std::vector<BoxPair> overlapsAmong(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                                   std::span<const EntryId> entries, double halo) {
  std::vector<Box> boxes;
  boxes.reserve(entries.size());
  for (const EntryId entry : entries) boxes.push_back(entryBox(surfaces, positions, entry, halo));
  std::vector<BoxPair> pairs = overlappingPairs(boxes);
  for (BoxPair& pair : pairs)
    pair = orderedPair(BoxId(entries[pair.first.value].value),
                       BoxId(entries[pair.second.value].value));
  return pairs;
}

void inheritTouches(std::vector<Touch>& touches, const ContactSurfaces& surfaces,
                    std::span<const NodeId> originals, std::size_t nodeCount) {
  assert(std::ranges::is_sorted(touches, {}, &Touch::pair));
  if (touches.empty()) return;
  const auto slaveAt = [&](NodeId node) {
    return surfaces.segmentEntry[surfaces.nodeSegment[node.value].value];
  };
  std::vector<Touch> more;
  const std::vector<Twin> twins = twinsOf(originals, nodeCount);
  for (std::size_t begin = 0, end = 0; begin < twins.size(); begin = end) {
    while (end < twins.size() && twins[end].original == twins[begin].original) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const EntryId from = slaveAt(twins[i].node);
      for (const Touch& touch : touchesOf(touches, from))
        for (std::size_t k = begin; k < end; ++k) {
          const EntryId to = slaveAt(twins[k].node);
          if (k != i && to != touch.pair.master && surfaces.prev[to.value] != touch.pair.master)
            more.push_back({{to, touch.pair.master}, 0, 0, touch.toleratedGap});
        }
    }
  }
  const auto byPair = [](const Touch& a, const Touch& b) { return a.pair < b.pair; };
  // Existing contacts come first: they have their forces.
  touches.insert(touches.end(), more.begin(), more.end());
  std::stable_sort(touches.begin(), touches.end(), byPair);
  touches.erase(std::unique(touches.begin(), touches.end(),
                            [](const Touch& a, const Touch& b) { return a.pair == b.pair; }),
                touches.end());
}

}  // namespace yadefrag
