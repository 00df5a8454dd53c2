#include "step/crack_candidates.hpp"

#include <algorithm>
#include <cassert>

#include "core/arrays.hpp"
#include "search/contact_search.hpp"
#include "step/entry_pairs.hpp"

namespace yadefrag {

std::vector<EntryId> entriesAround(const ContactSurfaces& surfaces, Candidates& candidates,
                                   std::span<const SurfaceSide> sides) {
  std::vector<EntryId> own;
  for (const SurfaceSide& side : sides) {
    const EntryId entry = surfaces.segmentEntry[surfaces.nodeSegment[side.first.value].value];
    // A segment has two entries at most; with two steps back the previous segment is included.
    EntryId at = surfaces.prev[surfaces.prev[entry.value].value];
    for (int k = 0; k < 6; ++k, at = surfaces.next[at.value]) own.push_back(at);
  }
  sortUnique(own);
  std::vector<EntryId> around(own);
  for (const EntryId entry : own) {
    candidates.appendSlavesOf(entry, around);
    const std::uint32_t row = candidates.rowOf(entry);
    if (row == Candidates::kNone) continue;
    const auto masters = candidates.mastersOf(row);
    around.insert(around.end(), masters.begin(), masters.end());
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

}  // namespace yadefrag
