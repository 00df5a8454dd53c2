#pragma once
// Do the surfaces of a cut mesh follow its triangles?

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "cut_mesh.hpp"
#include "surface_checks.hpp"

namespace yadefrag {

/// One boundary side, its segment, and the entries on it up to the next segment's first.
inline void checkSide(const CutMesh& mesh, SegmentId segment, NodeId first, NodeId last) {
  const ContactSurfaces& s = mesh.surfaces;
  const SegmentId following = s.segmentNext[segment.value];
  ASSERT_TRUE(s.segmentNode[segment.value] == first && s.segmentNode[following.value] == last);
  ASSERT_TRUE(s.nodeSegment[first.value] == segment && s.nodeSegment[last.value] == following);
  ASSERT_EQ(s.segmentPrev[following.value], segment);
  ASSERT_EQ(s.segmentNext[s.segmentPrev[segment.value].value], segment);
  ASSERT_EQ(s.isSmooth(segment) ? 1 : 0, mesh.smooth[first.value]);
  ASSERT_TRUE(piecesFitEnds(s, segment));
  const PieceGeometry geometry(s, mesh.positions);
  EntryId entry = s.segmentEntry[segment.value];
  for (; s.entrySegment[entry.value] == segment; entry = s.next[entry.value]) {
    const EntryId next = s.next[entry.value];
    ASSERT_TRUE(s.prev[next.value] == entry && s.next[s.prev[entry.value].value] == entry);
    ASSERT_EQ(s.component[next.value], s.component[entry.value]);
    ASSERT_TRUE(mesh.loopsOf.contains({s.component[entry.value].value, s.loop[entry.value]}));
    const PieceRange range = pieceRange(s.piece[entry.value]);
    ASSERT_LT(norm(geometry.point(entry, range.begin) - geometry.slave(entry)), 1e-12);
    ASSERT_LT(norm(geometry.point(entry, range.end) - geometry.slave(next)), 1e-12);
  }
  ASSERT_EQ(entry, s.segmentEntry[following.value]);
}

inline std::size_t countCycles(const std::vector<std::size_t>& next) {
  std::vector<bool> seen(next.size());
  std::size_t cycles = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    cycles += seen[i] ? 0 : 1;
    for (std::size_t k = i; !seen[k]; k = next[k]) seen[k] = true;
  }
  return cycles;
}

template <class IdType>
std::size_t countLists(const std::vector<IdType>& links) {
  std::vector<std::size_t> next;
  next.reserve(links.size());
  for (const IdType link : links) next.push_back(link.value);
  return countCycles(next);
}

/// Parts that are connected by edges.
inline std::size_t countPieces(const CutMesh& mesh) {
  std::vector<CutMesh::Row> top(mesh.triangles.size());
  std::iota(top.begin(), top.end(), 0);
  const auto find = [&](CutMesh::Row t) {
    while (top[t] != t) t = top[t] = top[top[t]];
    return t;
  };
  std::size_t pieces = top.size();
  mesh.forEachSide(0, [&](CutMesh::Side side) {
    if (mesh.isFace(side)) return;
    const CutMesh::Row a = find(side.triangle), b = find(mesh.at(mesh.across, side).triangle);
    pieces -= a != b ? 1 : 0;
    top[a] = b;
  });
  return pieces;
}

/// All laws, and that the boundary is the triangles' very own.
inline void checkMesh(const CutMesh& mesh) {
  const ContactSurfaces& s = mesh.surfaces;
  checkCrackedLinks(s);
  if (testing::Test::HasFatalFailure()) return;
  checkPiecesJoin(s);
  std::size_t faces = 0;
  mesh.forEachSide(0, [&](CutMesh::Side side) {
    if (!mesh.isFace(side) || testing::Test::HasFatalFailure()) return;
    ++faces;
    const SegmentId segment = mesh.at(mesh.segment, side);
    checkSide(mesh, segment, NodeId(mesh.from(side)), NodeId(mesh.to(side)));
    ASSERT_EQ(s.component[s.segmentEntry[segment.value].value], mesh.owner[side.triangle]);
  });
  if (testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(faces, s.segments());
  // Euler: V − E + F = 2 − boundary lists, for each piece.
  const std::size_t lists = countLists(s.segmentNext);
  ASSERT_EQ(lists, countLists(s.next));
  const std::size_t edges = (3 * mesh.triangles.size() + faces) / 2;
  ASSERT_EQ(mesh.positions.size() + mesh.triangles.size() + lists, edges + 2 * countPieces(mesh));
}

/// Numbers are for ever: what may differ after a relinking is little.
inline void checkOnlyAppended(const ContactSurfaces& before, const ContactSurfaces& after,
                              std::span<const SurfaceSide> sides,
                              std::vector<EntryId> straightened) {
  std::sort(straightened.begin(), straightened.end());
  std::vector<EntryId> expected;
  for (std::size_t e = 0; e < before.entries(); ++e) {
    ASSERT_TRUE(before.entrySegment[e] == after.entrySegment[e] &&
                before.loop[e] == after.loop[e] && before.component[e] == after.component[e]);
    ASSERT_TRUE(before.piece[e] == after.piece[e] ||
                (before.piece[e] == Piece::kArc && after.piece[e] == Piece::kSecondHalf));
    if (before.piece[e] != after.piece[e]) expected.emplace_back(e);
    ASSERT_EQ(weights(before.slave(EntryId(e))).size(), weights(after.slave(EntryId(e))).size());
  }
  ASSERT_EQ(straightened, expected);
  for (std::size_t e = before.entries(); e < after.entries(); ++e) {
    const bool isOld = after.entrySegment[e].value < before.segments();
    ASSERT_EQ(after.piece[e], isOld ? Piece::kFirstHalf : Piece::kSegment);
  }
  std::vector<bool> listed(after.segments());
  for (const SurfaceSide& side : sides)
    if (side.segment != SegmentId::none()) listed[side.segment.value] = true;
  for (std::size_t i = 0; i < before.segments(); ++i) {
    if (listed[i]) continue;
    ASSERT_TRUE(before.segmentNode[i] == after.segmentNode[i] &&
                before.segmentEntry[i] == after.segmentEntry[i] &&
                before.isSmooth(SegmentId(i)) == after.isSmooth(SegmentId(i)) &&
                before.segmentNext[i] == after.segmentNext[i] &&
                before.segmentPrev[i] == after.segmentPrev[i]);
  }
}

}  // namespace yadefrag
