#include "surface/contact_surface.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "surface_checks.hpp"

namespace yadefrag {
namespace {

std::vector<Piece> kinds(const ContactSurfaces& s) { return s.piece; }

TEST(ContactSurfaces, StraightLoopHasOneEntryPerNode) {
  const ContactSurfaces s = oneLoop({0, 0, 0, 0});
  checkLinks(s);
  EXPECT_EQ(kinds(s), std::vector<Piece>(4, Piece::kSegment));
  for (std::size_t e = 0; e < 4; ++e) {
    EXPECT_EQ(s.entrySegment[e], SegmentId(e));
    EXPECT_EQ(s.slave(EntryId(e)).node[0], NodeId(e));
  }
}

TEST(ContactSurfaces, SmoothLoopHasOneArcPerNode) {
  const ContactSurfaces s = oneLoop({1, 1, 1});
  checkLinks(s);
  EXPECT_EQ(kinds(s), std::vector<Piece>(3, Piece::kArc));
  NodeId nodes[3];
  ASSERT_EQ(s.pieceNodes(EntryId(std::size_t{0}), nodes), 3);
  EXPECT_EQ(nodes[0], NodeId(std::size_t{0}));
  EXPECT_EQ(nodes[1], NodeId(std::size_t{1}));
  EXPECT_EQ(nodes[2], NodeId(std::size_t{2}));
}

TEST(ContactSurfaces, MixedLoopHasHalves) {
  const ContactSurfaces s = oneLoop({0, 1, 0, 0, 1, 1});
  checkLinks(s);
  const std::vector<Piece> expected = {Piece::kFirstHalf, Piece::kArc,       Piece::kSecondHalf,
                                       Piece::kSegment,   Piece::kFirstHalf, Piece::kArc,
                                       Piece::kArc,       Piece::kSecondHalf};
  EXPECT_EQ(kinds(s), expected);
  const std::size_t segments[] = {0, 0, 1, 2, 3, 3, 4, 5};
  for (std::size_t e = 0; e < 8; ++e) EXPECT_EQ(s.entrySegment[e], SegmentId(segments[e])) << e;
}

TEST(ContactSurfaces, PiecesJoinWithoutGaps) {
  // The end of every piece is the sampling point of the next entry, for every pattern of corners.
  for (std::size_t n = 3; n <= 7; ++n)
    for (unsigned pattern = 0; pattern < (1U << n); ++pattern) {
      std::vector<std::uint8_t> smooth;
      for (std::size_t i = 0; i < n; ++i) smooth.push_back((pattern >> i) & 1);
      const ContactSurfaces s = oneLoop(smooth);
      checkLinks(s);
      checkPiecesJoin(s);
    }
}

ContactSurfaces randomSurfaces(std::mt19937& random, std::vector<ComponentId>& ownerOfNode) {
  ContactSurfaces s;
  std::vector<NodeId> all;
  const std::size_t loops = 1 + random() % 6;
  for (std::size_t k = 0; k < loops; ++k) {
    std::vector<NodeId> nodes(3 + random() % 5);
    std::vector<std::uint8_t> smooth(nodes.size());
    const ComponentId owner(std::size_t{random() % 3});
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      ownerOfNode.insert(ownerOfNode.end(), 1 + random() % 2, owner);  // with inner nodes
      nodes[i] = NodeId(ownerOfNode.size() - 1);
      smooth[i] = random() % 2;
    }
    EXPECT_EQ(s.addLoop(nodes, smooth, owner), k);
  }
  s.nodeSegment.resize(ownerOfNode.size(), SegmentId::none());
  return s;
}

/// Pieces and nodes of the entries of the components that stay, in order.
std::vector<std::uint32_t> fingerprint(const ContactSurfaces& s, ComponentId gone) {
  std::vector<std::uint32_t> print;
  for (std::size_t e = 0; e < s.entries(); ++e) {
    if (s.component[e] == gone) continue;
    NodeId nodes[3];
    const int count = s.pieceNodes(EntryId(e), nodes);
    for (int i = 0; i < count; ++i) print.push_back(nodes[i].value);
    print.push_back(static_cast<std::uint32_t>(s.piece[e]));
  }
  return print;
}

TEST(ContactSurfaces, RemovedComponentLeavesTheOthersAsTheyWere) {
  std::mt19937 random(3);
  for (int k = 0; k < 300; ++k) {
    std::vector<ComponentId> owner;
    ContactSurfaces s = randomSurfaces(random, owner);
    const ComponentId gone(std::size_t{random() % 3});
    const auto before = fingerprint(s, gone);
    s.removeComponent(gone);
    checkLinks(s);
    checkPiecesJoin(s);
    EXPECT_EQ(fingerprint(s, ComponentId::none()), before);

    std::vector<NodeId> renumbered(owner.size(), NodeId::none());
    std::size_t left = 0;
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (owner[i] != gone) renumbered[i] = NodeId(left++);
    s.renumberNodes(renumbered, left);
    checkLinks(s);
    EXPECT_EQ(s.nodeSegment.size(), left);

    const NodeId more[] = {NodeId(left), NodeId(left + 1), NodeId(left + 2)};
    const std::uint8_t corners[] = {0, 1, 0};
    s.addLoop(more, corners, gone);
    checkLinks(s);
    checkPiecesJoin(s);
  }
}

}  // namespace
}  // namespace yadefrag
