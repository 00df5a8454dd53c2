// Sides that a mesh begins with. Single relinkings by hand; meshes that crack to pieces:
// fracture/node_splitting_test.cpp.

#include <gtest/gtest.h>

#include <vector>

#include "contact/pass_rule.hpp"
#include "step/search_schedule.hpp"
#include "surface/contact_surface.hpp"
#include "surface_checks.hpp"

namespace yadefrag {
namespace {

TEST(ContactSurfaces, MixedLoopHasHalves) {
  const ContactSurfaces s = oneLoop({0, 1, 0, 0, 1, 1});
  checkLinks(s);
  const std::vector<Piece> expected = {Piece::kFirstHalf, Piece::kArc,       Piece::kSecondHalf,
                                       Piece::kSegment,   Piece::kFirstHalf, Piece::kArc,
                                       Piece::kArc,       Piece::kSecondHalf};
  EXPECT_EQ(s.piece, expected);
  const std::size_t segments[] = {0, 0, 1, 2, 3, 3, 4, 5};
  for (std::size_t e = 0; e < 8; ++e) EXPECT_EQ(s.entrySegment[e], SegmentId(segments[e])) << e;
  EXPECT_EQ(s.slave(EntryId(std::size_t{3})).node[0], NodeId(std::size_t{2}));
  NodeId nodes[3];
  ASSERT_EQ(s.pieceNodes(EntryId(std::size_t{1}), nodes), 3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(nodes[k], NodeId(k));
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

const ComponentId kBody(std::size_t{0});
const std::vector<Piece> kHalves{Piece::kFirstHalf, Piece::kSecondHalf};
const std::vector<Piece> kToArc{Piece::kFirstHalf, Piece::kArc};

SegmentId segment(std::size_t number) { return SegmentId(number); }
NodeId node(std::size_t number) { return NodeId(number); }

/// A square of 2 m, whose lower side has a smooth node in its middle, from which a crack runs 1 m
/// into the body: node 1 is doubled as node 5, and node 6 is the tip.
struct Cracked {
  ContactSurfaces surfaces = oneLoop({0, 1, 0, 0, 0});
  std::vector<Vec2> positions{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {1, 1}};
  std::vector<SurfaceSide> sides{{segment(0), node(0), node(1), kBody},
                                 {SegmentId::none(), node(1), node(6), kBody},
                                 {SegmentId::none(), node(6), node(5), kBody},
                                 {segment(1), node(5), node(2), kBody}};

  Cracked() {
    const ContactSurfaces before = surfaces;
    const std::vector<EntryId> straightened = relink(surfaces, sides);
    checkCrackedLinks(surfaces);
    checkPiecesJoin(surfaces);
    checkOnlyAppended(before, surfaces, sides, straightened);
  }
  /// The first entry of a segment, and the one after it.
  [[nodiscard]] EntryId first(std::size_t of) const { return surfaces.segmentEntry[of]; }
  [[nodiscard]] EntryId second(std::size_t of) const { return surfaces.next[first(of).value]; }
};

TEST(Relink, ACrackFromASmoothNodeMakesHalvesBesideIt) {
  const Cracked cracked;
  const ContactSurfaces& s = cracked.surfaces;
  EXPECT_EQ(s.segments(), 7U);
  EXPECT_EQ(piecesOf(s, segment(0)), kHalves);
  EXPECT_EQ(piecesOf(s, segment(1)), kHalves);
  // Inwards along one face, back along the other.
  EXPECT_EQ(s.segmentNext[0], segment(5));
  EXPECT_EQ(s.segmentNext[5], segment(6));
  EXPECT_EQ(s.segmentNext[6], segment(1));
}

TEST(Relink, LoopNumbersAreThoseOfTheLoopsPiecesWereMadeIn) {
  ContactSurfaces s = oneLoop({0, 0, 0, 0});
  const std::vector<NodeId> hole{node(4), node(5), node(6), node(7)};
  EXPECT_EQ(s.addLoop(hole, std::vector<std::uint8_t>(4), kBody), 1U);
  const auto loopAt = [&](std::size_t of) { return s.loop[s.segmentEntry[of].value]; };
  const SegmentId added = SegmentId::none();
  // A slit inside has the component's lowest number, a crack from the hole that of the hole.
  relink(s, std::vector<SurfaceSide>{{added, node(8), node(9), kBody},
                                     {added, node(9), node(10), kBody},
                                     {added, node(10), node(11), kBody},
                                     {added, node(11), node(8), kBody}});
  for (std::size_t i = 8; i < 12; ++i) EXPECT_EQ(loopAt(i), 0U);
  relink(s, std::vector<SurfaceSide>{{segment(7), node(7), node(4), kBody},
                                     {added, node(4), node(13), kBody},
                                     {added, node(13), node(12), kBody},
                                     {segment(4), node(12), node(5), kBody}});
  EXPECT_EQ(loopAt(12), 1U);
  EXPECT_EQ(loopAt(13), 1U);
  checkCrackedLinks(s);
}

TEST(Relink, ListedWithoutAChangeNothingHappens) {
  Cracked cracked;
  ContactSurfaces& s = cracked.surfaces;
  const ContactSurfaces before = s;
  std::vector<SurfaceSide> all;
  for (std::size_t i = 0; i < s.segments(); ++i)
    all.push_back({segment(i), s.segmentNode[i], s.segmentNode[s.segmentNext[i].value], kBody});
  for (const auto& sides : {all, std::vector<SurfaceSide>{}}) {
    relink(s, sides);
    EXPECT_EQ(before.segmentNext, s.segmentNext);
    EXPECT_EQ(before.nodeSegment, s.nodeSegment);
    EXPECT_EQ(before.next, s.next);
    EXPECT_EQ(before.prev, s.prev);
    EXPECT_TRUE(before.piece == s.piece);
  }
}

TEST(Relink, ANodeThatLeavesTheBoundaryHasNoSegment) {
  ContactSurfaces s = oneLoop({0, 1, 1, 0});
  // Node 1's two sides go on at a new node 7.
  const SurfaceSide sides[] = {{segment(0), node(0), node(7), kBody},
                               {segment(1), node(7), node(2), kBody}};
  relink(s, sides);
  checkLinks(s);
  checkPiecesJoin(s);
  EXPECT_EQ(s.nodeSegment[1], SegmentId::none());
  EXPECT_EQ(s.nodeSegment[7], SegmentId(std::size_t{1}));
  EXPECT_EQ(s.nodeSegment.size(), 8U);
  EXPECT_EQ(piecesOf(s, SegmentId(std::size_t{0})), kHalves);
  EXPECT_EQ(piecesOf(s, SegmentId(std::size_t{1})), kToArc);
}

TEST(Relink, TwoHalvesBetweenCornersAreTheSegment) {
  const Cracked cracked;
  const EntryId first = cracked.first(0), second = cracked.second(0);
  const PieceGeometry geometry(cracked.surfaces, cracked.positions);
  for (const double xi : {0., .25, .5, .75, 1.})
    EXPECT_LT(norm(geometry.point(xi < .5 ? first : second, xi) - Vec2{xi, 0}), 1e-15);
  EXPECT_DOUBLE_EQ(geometry.length(first) + geometry.length(second), 1);
  EXPECT_EQ(geometry.ends(first).end, geometry.ends(second).begin);
  EXPECT_EQ(geometry.box(first).max[0], .5);
  EXPECT_EQ(geometry.box(second).min[0], .5);
  EXPECT_EQ(normalOf(geometry, second, .5), (Vec2{0, -1}));
  // A point over the segment has its foot on one of the two, with the same gap on both.
  for (const Vec2 point : {Vec2{.2, .1}, Vec2{.7, .1}}) {
    EXPECT_EQ(geometry.foot(first, point).inside, point.x < .5);
    EXPECT_EQ(geometry.foot(second, point).inside, point.x > .5);
    EXPECT_EQ(geometry.foot(first, point).gap, geometry.foot(second, point).gap);
  }
}

TEST(Relink, ContactTakesTwoHalvesBetweenCorners) {
  Cracked cracked;
  ContactSurfaces& s = cracked.surfaces;
  std::vector<NodeId> finer;
  for (std::size_t k = 0; k < 32; ++k) {
    finer.push_back(node(7 + k));
    const double along = .125 * static_cast<double>(k % 8);
    cracked.positions.push_back(Vec2{9, 0} + (k < 8    ? Vec2{along, 0}
                                              : k < 16 ? Vec2{1, along}
                                              : k < 24 ? Vec2{1 - along, 1}
                                                       : Vec2{0, 1 - along}));
  }
  s.addLoop(finer, std::vector<std::uint8_t>(32), ComponentId(std::size_t{1}));
  const EntryId first = cracked.first(0), second = cracked.second(0);
  Model model;
  Component component;
  component.selfContact = true;
  component.brittle.tensileStrength = 1;
  model.components = {component, Component{}};
  PassRule rule;
  rule.update(s, cracked.positions, {.passes = 1});
  // Even the point at which two halves go straight on is a slave: the next crack may make it a
  // corner.
  const EntryId other = s.segmentEntry[7];
  EXPECT_TRUE(rule.mayBeSlave(model, s, second, other));
  EXPECT_TRUE(rule.mayBeSlave(model, s, other, second));

  const auto pairsOf = [&](EntryId a, EntryId b) {
    const std::vector<BoxPair> overlapping{orderedPair(BoxId(a.value), BoxId(b.value))};
    std::vector<SlaveMaster> pairs;
    selectPairs(model, s, rule, cracked.positions, .1, overlapping, pairs);
    return pairs;
  };
  // The halfpoint is the first half's own end; the corner is not near the second half.
  EXPECT_TRUE(pairsOf(first, second).empty());
  // The two faces of the crack: each one's beginning is in the other's halo, as its end, but not
  // the tip, where the one ends and the other begins.
  const EntryId in = cracked.first(5), out = cracked.first(6);
  const std::vector<SlaveMaster> faces = pairsOf(in, out);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_EQ(faces[0], (SlaveMaster{in, out}));
}

}  // namespace
}  // namespace yadefrag
