#include "step/search_schedule.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/arrays.hpp"
#include "search/contact_search.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// True if a point is in the strip of width δ around a piece; for an arc, around its control
/// points.
bool isInHalo(const PieceGeometry& geometry, const ContactSurfaces& surfaces,
              std::span<const Vec2> positions, EntryId master, Vec2 point, double halo) {
  const PieceEnds ends = geometry.ends(master);
  double width = halo;
  if (surfaces.piece[master.value] == Piece::kArc) {
    NodeId nodes[3];
    surfaces.pieceNodes(master, nodes);
    width += norm(positions[nodes[1].value] - .5 * (ends.begin + ends.end));
  }
  const Vec2 along = ends.end - ends.begin;
  const Vec2 from = point - ends.begin;
  const double length = norm(along);
  const double at = dot(along, from) / length;
  return std::abs(cross(along, from)) <= width * length && at >= -width && at <= length + width;
}

}  // namespace

Box entryBox(const ContactSurfaces& surfaces, std::span<const Vec2> positions, EntryId entry,
             double halo) {
  Box box = PieceGeometry(surfaces, positions).box(entry);
  for (std::size_t axis = 0; axis < 2; ++axis) box.min[axis] -= halo / 2, box.max[axis] += halo / 2;
  return box;
}

void selectPairs(const Model& model, const ContactSurfaces& surfaces, const PassRule& rule,
                 std::span<const Vec2> positions, double halo, std::span<const BoxPair> overlapping,
                 std::vector<SlaveMaster>& pairs) {
  const PieceGeometry geometry(surfaces, positions);
  const auto consider = [&](EntryId slave, EntryId master) {
    if (surfaces.prev[slave.value] == master) return;  // the slave is the master's end
    if (!rule.mayBeSlave(model, surfaces, slave, master)) return;
    if (isInHalo(geometry, surfaces, positions, master, geometry.slave(slave), halo))
      pairs.push_back({slave, master});
  };
  for (const BoxPair& pair : overlapping) {
    const EntryId a(pair.first.value), b(pair.second.value);
    if (!mayTouch(model, surfaces.component[a.value], surfaces.component[b.value])) continue;
    consider(a, b);
    consider(b, a);
  }
}

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
    const auto masters = candidates.mastersOf(entry);
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
