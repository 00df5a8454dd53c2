#pragma once
// What must hold for every contact surface, at any time.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "surface/contact_surface.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

inline ContactSurfaces oneLoop(const std::vector<std::uint8_t>& smooth) {
  ContactSurfaces s;
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < smooth.size(); ++i) nodes.emplace_back(i);
  s.addLoop(nodes, smooth, ComponentId(std::size_t{0}));
  return s;
}

inline Vec2 normalOf(const PieceGeometry& geometry, EntryId entry, double xi) {
  const Vec2 right = rightOf(geometry.tangent(entry, xi));
  return (1 / norm(right)) * right;
}

inline void checkSegments(const ContactSurfaces& s) {
  const std::size_t n = s.segments();
  ASSERT_TRUE(s.segmentNext.size() == n && s.segmentPrev.size() == n &&
              (s.segmentSmooth.empty() || s.segmentSmooth.size() == n) &&
              s.segmentEntry.size() == n);
  std::size_t withSegment = 0;
  for (const SegmentId segment : s.nodeSegment) withSegment += segment != SegmentId::none();
  ASSERT_EQ(withSegment, n);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(s.segmentPrev[s.segmentNext[i].value], SegmentId(i));
    ASSERT_EQ(s.segmentNext[s.segmentPrev[i].value], SegmentId(i));
    ASSERT_EQ(s.nodeSegment[s.segmentNode[i].value], SegmentId(i));
    const EntryId entry = s.segmentEntry[i];
    ASSERT_EQ(s.entrySegment[entry.value], SegmentId(i));
    // The first one on its segment: the one before lies on the segment before.
    ASSERT_EQ(s.entrySegment[s.prev[entry.value].value], s.segmentPrev[i]);
    const bool onNode = s.slave(entry).count == 1;
    ASSERT_EQ(onNode, !s.isSmooth(SegmentId(i)));
  }
}

/// The kinds of a segment's entries, in order.
inline std::vector<Piece> piecesOf(const ContactSurfaces& s, SegmentId segment) {
  std::vector<Piece> pieces;
  EntryId entry = s.segmentEntry[segment.value];
  // Three would be one too many already.
  for (; s.entrySegment[entry.value] == segment && pieces.size() < 3; entry = s.next[entry.value])
    pieces.push_back(s.piece[entry.value]);
  return pieces;
}

/// Do they fit the segment's ends? Two halves between corners: an end was smooth once.
inline bool piecesFitEnds(const ContactSurfaces& s, SegmentId segment) {
  using P = std::vector<Piece>;
  const P pieces = piecesOf(s, segment);
  const bool from = s.isSmooth(segment);
  const bool to = s.isSmooth(s.segmentNext[segment.value]);
  if (from) return pieces == P{to ? Piece::kArc : Piece::kSecondHalf};
  if (to) return pieces == P{Piece::kFirstHalf, Piece::kArc};
  return pieces == P{Piece::kSegment} || pieces == P{Piece::kFirstHalf, Piece::kSecondHalf};
}

/// The links are a permutation and its inverse: all lists are closed.
inline void checkEntries(const ContactSurfaces& s) {
  const std::size_t n = s.entries();
  ASSERT_TRUE(s.entrySegment.size() == n && s.piece.size() == n && s.next.size() == n &&
              s.prev.size() == n && s.loop.size() == n && s.component.size() == n);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < s.segments(); ++i) {
    ASSERT_TRUE(piecesFitEnds(s, SegmentId(i))) << i;
    expected += piecesOf(s, SegmentId(i)).size();
  }
  ASSERT_EQ(n, expected);
  for (std::size_t e = 0; e < n; ++e) {
    const EntryId next = s.next[e];
    ASSERT_EQ(s.prev[next.value], EntryId(e));
    ASSERT_EQ(s.next[s.prev[e].value], EntryId(e));
    ASSERT_EQ(s.component[next.value], s.component[e]);
    const SegmentId segment = s.entrySegment[e];
    if (s.entrySegment[next.value] == segment) continue;
    ASSERT_EQ(s.entrySegment[next.value], s.segmentNext[segment.value]);
    ASSERT_EQ(next, s.segmentEntry[s.segmentNext[segment.value].value]);
  }
}

inline void checkLoopNumbers(const ContactSurfaces& s) {
  const std::set<std::uint32_t> loops(s.loop.begin(), s.loop.end());
  if (!loops.empty()) {
    ASSERT_EQ(*loops.rbegin() + 1, loops.size());
  }
}

/// Surfaces that have cracked, too.
inline void checkCrackedLinks(const ContactSurfaces& s) {
  checkSegments(s);
  if (!testing::Test::HasFatalFailure()) checkEntries(s);
  if (!testing::Test::HasFatalFailure()) checkLoopNumbers(s);
}

/// As long as nothing has cracked, a list is the loop in which it was made.
inline void checkLinks(const ContactSurfaces& s) {
  checkCrackedLinks(s);
  if (testing::Test::HasFatalFailure()) return;
  for (std::size_t e = 0; e < s.entries(); ++e) ASSERT_EQ(s.loop[s.next[e].value], s.loop[e]);
}

inline std::map<std::uint32_t, double> weights(const Stencil& stencil) {
  std::map<std::uint32_t, double> sum;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(i < stencil.count || stencil.weight[i] == 0);
    if (stencil.weight[i] != 0) sum[stencil.node[i].value] += stencil.weight[i];
  }
  return sum;
}

/// Every piece begins at its own sampling point and ends at the next one's.
inline void checkPiecesJoin(const ContactSurfaces& s) {
  for (std::size_t e = 0; e < s.entries(); ++e) {
    const PieceRange range = pieceRange(s.piece[e]);
    const auto own = weights(s.slave(EntryId(e)));
    const auto following = weights(s.slave(s.next[e]));
    EXPECT_EQ(weights(s.master(EntryId(e), range.begin)), own);
    EXPECT_EQ(weights(s.master(EntryId(e), range.end)), following);
  }
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
