#include "surface/contact_surface.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <vector>

#include "contact/pass_rule.hpp"
#include "cut_mesh.hpp"
#include "meshing/triangulate.hpp"
#include "step/halo_watch.hpp"

namespace yadefrag {
namespace {

using P = std::vector<Piece>;
using Side = CutMesh::Side;

const ComponentId kBody(std::size_t{0});

/// Unit quads; smooth where `smooth` has a point.
CutMesh square(int n, const std::vector<Vec2>& smooth = {}) {
  const TriangleMesh mesh = structuredRectangle({0, 0}, {1. * n, 1. * n}, n, n);
  CutMesh cut;
  cut.addBody(mesh, kBody, [&](CutMesh::Row node) {
    return std::ranges::find(smooth, mesh.nodes[node]) != smooth.end();
  });
  return cut;
}

void crack(CutMesh& mesh, const std::vector<std::pair<Vec2, Vec2>>& edges) {
  std::vector<Side> sides;
  sides.reserve(edges.size());
  for (const auto& [a, b] : edges) sides.push_back(mesh.sideAt(a, b));
  const ContactSurfaces before = mesh.surfaces;
  const std::vector<SurfaceSide> listed = mesh.crack(sides);
  const std::vector<EntryId> straightened = relink(mesh.surfaces, listed);
  checkMesh(mesh);
  checkOnlyAppended(before, mesh.surfaces, listed, straightened);
}

SegmentId segmentAt(const CutMesh& mesh, Vec2 a, Vec2 b) {
  return mesh.at(mesh.segment, mesh.sideAt(a, b));
}
P piecesAt(const CutMesh& mesh, Vec2 a, Vec2 b) {
  return piecesOf(mesh.surfaces, segmentAt(mesh, a, b));
}
EntryId firstAt(const CutMesh& mesh, Vec2 a, Vec2 b) {
  return mesh.surfaces.segmentEntry[segmentAt(mesh, a, b).value];
}

const P kWhole{Piece::kSegment};
const P kHalves{Piece::kFirstHalf, Piece::kSecondHalf};
const P kToArc{Piece::kFirstHalf, Piece::kArc};
const P kOnlyArc{Piece::kArc};
const P kFromArc{Piece::kSecondHalf};

TEST(Relink, CrackFromAStraightBoundaryIntoTheBody) {
  CutMesh mesh = square(4);
  crack(mesh, {{{2, 0}, {2, 1}}});
  EXPECT_EQ(mesh.positions.size(), 26U);
  EXPECT_EQ(mesh.surfaces.segments(), 18U);
  EXPECT_EQ(mesh.surfaces.entries(), 18U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 1U);
  for (const Piece piece : mesh.surfaces.piece) EXPECT_EQ(piece, Piece::kSegment);
  // Inwards along one face, back along the other.
  const SegmentId in = segmentAt(mesh, {2, 0}, {2, 1});
  const SegmentId out = segmentAt(mesh, {2, 1}, {2, 0});
  EXPECT_EQ(mesh.surfaces.segmentPrev[in.value], segmentAt(mesh, {1, 0}, {2, 0}));
  EXPECT_EQ(mesh.surfaces.segmentNext[in.value], out);
  EXPECT_EQ(mesh.surfaces.segmentNext[out.value], segmentAt(mesh, {2, 0}, {3, 0}));

  crack(mesh, {{{2, 1}, {2, 2}}});  // the tip goes on
  EXPECT_EQ(mesh.surfaces.segments(), 20U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 1U);
}

TEST(Relink, CrackFromASmoothNode) {
  CutMesh mesh = square(4, {{2, 0}});
  EXPECT_EQ(piecesAt(mesh, {1, 0}, {2, 0}), kToArc);
  const EntryId first = firstAt(mesh, {1, 0}, {2, 0});
  const EntryId arc = mesh.surfaces.next[first.value];
  const EntryId after = firstAt(mesh, {2, 0}, {3, 0});
  const std::size_t entries = mesh.surfaces.entries();
  crack(mesh, {{{2, 0}, {2, 1}}});
  EXPECT_EQ(piecesAt(mesh, {1, 0}, {2, 0}), kHalves);
  EXPECT_EQ(piecesAt(mesh, {2, 0}, {3, 0}), kHalves);
  EXPECT_EQ(mesh.surfaces.entries(), entries + 3);
  EXPECT_EQ(mesh.surfaces.piece[arc.value], Piece::kSecondHalf);
  EXPECT_EQ(mesh.surfaces.next[first.value], arc);
  EXPECT_EQ(mesh.surfaces.next[arc.value], firstAt(mesh, {2, 0}, {2, 1}));
  const EntryId added = firstAt(mesh, {2, 0}, {3, 0});
  EXPECT_GE(added.value, entries);
  EXPECT_EQ(mesh.surfaces.next[added.value], after);
  EXPECT_EQ(mesh.surfaces.prev[added.value], firstAt(mesh, {2, 1}, {2, 0}));
}

TEST(Relink, SmoothNeighboursKeepTheirArcs) {
  CutMesh mesh = square(4, {{1, 0}, {2, 0}, {3, 0}});
  crack(mesh, {{{2, 0}, {2, 1}}});
  EXPECT_EQ(piecesAt(mesh, {0, 0}, {1, 0}), kToArc);
  EXPECT_EQ(piecesAt(mesh, {1, 0}, {2, 0}), kFromArc);
  EXPECT_EQ(piecesAt(mesh, {2, 0}, {3, 0}), kToArc);
  EXPECT_EQ(piecesAt(mesh, {3, 0}, {4, 0}), kFromArc);
}

TEST(Relink, BetweenTwoSmoothNodesBothEndsAtOnceOrInTurn) {
  const std::vector<Vec2> smooth{{1, 0}, {2, 0}, {3, 0}, {4, 0}};
  const std::pair<Vec2, Vec2> left{{2, 0}, {2, 1}}, right{{3, 0}, {3, 1}};
  for (int order = 0; order < 3; ++order) {
    CutMesh mesh = square(4, smooth);
    EXPECT_EQ(piecesAt(mesh, {2, 0}, {3, 0}), kOnlyArc);
    const EntryId arc = firstAt(mesh, {2, 0}, {3, 0});
    if (order == 0) crack(mesh, {left, right});
    if (order == 1) crack(mesh, {left}), crack(mesh, {right});
    if (order == 2) crack(mesh, {right}), crack(mesh, {left});
    EXPECT_EQ(piecesAt(mesh, {1, 0}, {2, 0}), kFromArc);
    EXPECT_EQ(piecesAt(mesh, {2, 0}, {3, 0}), kHalves);
    EXPECT_EQ(mesh.surfaces.next[firstAt(mesh, {2, 0}, {3, 0}).value], arc);
    EXPECT_EQ(piecesAt(mesh, {3, 0}, {4, 0}), kToArc);
  }
}

TEST(Relink, SlitInsideReachesTheSurfaceLater) {
  CutMesh mesh = square(4, {{4, 2}, {4, 3}});
  crack(mesh, {{{1, 2}, {2, 2}}});  // neither end is cut: no faces yet
  EXPECT_EQ(mesh.surfaces.segments(), 16U);
  crack(mesh, {{{2, 2}, {3, 2}}});
  EXPECT_EQ(mesh.surfaces.segments(), 20U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 2U);
  crack(mesh, {{{3, 2}, {4, 2}}});
  EXPECT_EQ(mesh.surfaces.segments(), 22U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 1U);
  EXPECT_EQ(piecesAt(mesh, {4, 1}, {4, 2}), kHalves);
  EXPECT_EQ(piecesAt(mesh, {4, 2}, {4, 3}), kToArc);
  EXPECT_EQ(countPieces(mesh), 1U);
  crack(mesh, {{{0, 2}, {1, 2}}});
  EXPECT_EQ(countPieces(mesh), 2U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 2U);
}

TEST(Relink, CornerElementComesLoose) {
  for (const bool smooth : {false, true}) {
    CutMesh mesh = smooth ? square(3, {{2, 0}, {3, 0}, {3, 1}}) : square(3);
    crack(mesh, {{{3, 1}, {2, 0}}});
    EXPECT_EQ(countPieces(mesh), 2U);
    EXPECT_EQ(countLists(mesh.surfaces.next), 2U);
    EXPECT_EQ(mesh.surfaces.segments(), 14U);
    // The tip of the corner was not touched: it stays as it was.
    EXPECT_EQ(piecesAt(mesh, {2, 0}, {3, 0}), smooth ? kToArc : kWhole);
    EXPECT_EQ(piecesAt(mesh, {3, 0}, {3, 1}), smooth ? kFromArc : kWhole);
    EXPECT_EQ(piecesAt(mesh, {3, 1}, {2, 0}), kWhole);
  }
}

TEST(Relink, ATriangleInsideComesLoose) {
  CutMesh mesh = square(4);
  crack(mesh, {{{2, 2}, {3, 2}}, {{3, 2}, {3, 3}}, {{3, 3}, {2, 2}}});
  EXPECT_EQ(countPieces(mesh), 2U);
  EXPECT_EQ(countLists(mesh.surfaces.next), 3U);
  EXPECT_EQ(mesh.surfaces.segments(), 22U);
}

TEST(Relink, BodyIsCutInTwoAtOnceOrStepByStep) {
  for (const bool atOnce : {false, true}) {
    CutMesh mesh = square(4, {{2, 0}, {1, 4}, {2, 4}});
    std::vector<std::pair<Vec2, Vec2>> cut;
    cut.reserve(4);
    for (int i = 0; i < 4; ++i) cut.push_back({{2, 1. * i}, {2, i + 1.}});
    if (atOnce) crack(mesh, cut);
    for (const auto& edge : cut)
      if (!atOnce) crack(mesh, {edge});
    EXPECT_EQ(countPieces(mesh), 2U);
    EXPECT_EQ(countLists(mesh.surfaces.next), 2U);
    EXPECT_EQ(piecesAt(mesh, {2, 4}, {1, 4}), kToArc);
    EXPECT_EQ(piecesAt(mesh, {3, 4}, {2, 4}), kHalves);
  }
}

/// A square with a hole of 2 × 2 quads.
TriangleMesh frame() {
  TriangleMesh mesh = structuredRectangle({0, 0}, {6, 6}, 6, 6);
  std::erase_if(mesh.triangles, [&](const auto& corners) {
    const Vec2 middle =
        (1 / 3.) * (mesh.nodes[corners[0]] + mesh.nodes[corners[1]] + mesh.nodes[corners[2]]);
    return std::abs(middle.x - 3) < 1 && std::abs(middle.y - 3) < 1;
  });
  return mesh;
}

TEST(Relink, LoopNumbersAreThoseOfTheLoopsPiecesWereMadeIn) {
  CutMesh mesh;
  const auto noneSmooth = [](CutMesh::Row) { return false; };
  mesh.addBody(structuredRectangle({-9, 0}, {-8, 1}, 1, 1), ComponentId(std::size_t{3}),
               noneSmooth);
  TriangleMesh body = frame();
  // Its middle node belongs to no triangle any more: leave it out.
  const auto middle = std::ranges::find(body.nodes, Vec2{3, 3});
  const auto gone = static_cast<std::uint32_t>(middle - body.nodes.begin());
  body.nodes.erase(middle);
  for (auto& corners : body.triangles)
    for (std::uint32_t& node : corners) node -= node > gone ? 1 : 0;
  mesh.addBody(body, kBody, noneSmooth);
  ASSERT_EQ(mesh.loopsOf.size(), 3U);
  const auto loopAt = [&](Vec2 a, Vec2 b) { return mesh.surfaces.loop[firstAt(mesh, a, b).value]; };
  const std::uint32_t outline = loopAt({0, 0}, {1, 0}), hole = loopAt({3, 2}, {2, 2});
  EXPECT_NE(outline, hole);

  crack(mesh, {{{1, 4}, {1, 5}}, {{1, 5}, {2, 5}}});  // inside: the component's lowest
  EXPECT_EQ(loopAt({1, 4}, {1, 5}), std::min(outline, hole));
  EXPECT_EQ(loopAt({2, 5}, {1, 5}), std::min(outline, hole));
  crack(mesh, {{{3, 2}, {3, 1}}});  // from the hole: the hole's
  EXPECT_EQ(loopAt({3, 2}, {3, 1}), hole);
  EXPECT_EQ(loopAt({3, 1}, {3, 2}), hole);
  crack(mesh, {{{3, 1}, {3, 0}}});  // hole and outline become one list
  EXPECT_EQ(countLists(mesh.surfaces.next), 3U);
  EXPECT_EQ(loopAt({0, 0}, {1, 0}), outline);
  EXPECT_EQ(loopAt({3, 0}, {3, 1}), outline);
  EXPECT_EQ(loopAt({3, 1}, {3, 0}), hole);
  EXPECT_EQ(countPieces(mesh), 2U);
}

TEST(Relink, ListedWithoutAChangeNothingHappens) {
  CutMesh mesh = square(4, {{2, 0}, {3, 0}, {4, 0}});
  crack(mesh, {{{2, 0}, {2, 1}}});
  const ContactSurfaces before = mesh.surfaces;
  std::vector<SurfaceSide> all;
  mesh.forEachSide(0, [&](Side side) {
    if (mesh.isFace(side))
      all.push_back(
          {mesh.at(mesh.segment, side), NodeId(mesh.from(side)), NodeId(mesh.to(side)), kBody});
  });
  relink(mesh.surfaces, all);
  EXPECT_EQ(before.segmentNext, mesh.surfaces.segmentNext);
  EXPECT_EQ(before.nodeSegment, mesh.surfaces.nodeSegment);
  EXPECT_EQ(before.next, mesh.surfaces.next);
  EXPECT_EQ(before.prev, mesh.surfaces.prev);
  EXPECT_TRUE(before.piece == mesh.surfaces.piece);
  relink(mesh.surfaces, {});
  EXPECT_EQ(before.next, mesh.surfaces.next);
}

TEST(Relink, ANodeThatLeavesTheBoundaryHasNoSegment) {
  ContactSurfaces s = oneLoop({0, 1, 1, 0});
  // Node 1's two sides go on at a new node 7.
  const SurfaceSide sides[] = {
      {SegmentId(std::size_t{0}), NodeId(std::size_t{0}), NodeId(std::size_t{7}), kBody},
      {SegmentId(std::size_t{1}), NodeId(std::size_t{7}), NodeId(std::size_t{2}), kBody}};
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
  CutMesh mesh = square(4, {{2, 0}});
  crack(mesh, {{{2, 0}, {2, 1}}});
  const EntryId first = firstAt(mesh, {1, 0}, {2, 0});
  const EntryId second = mesh.surfaces.next[first.value];
  const PieceGeometry geometry(mesh.surfaces, mesh.positions);
  for (const double xi : {0., .25, .5, .75, 1.})
    EXPECT_LT(norm(geometry.point(xi < .5 ? first : second, xi) - Vec2{1 + xi, 0}), 1e-15);
  EXPECT_DOUBLE_EQ(geometry.length(first) + geometry.length(second), 1);
  EXPECT_EQ(geometry.ends(first).end, geometry.ends(second).begin);
  EXPECT_EQ(geometry.box(first).max[0], 1.5);
  EXPECT_EQ(geometry.box(second).min[0], 1.5);
  EXPECT_EQ(normalOf(geometry, second, .5), (Vec2{0, -1}));
  // A point over the segment has its foot on one of the two, with the same gap on both.
  for (const Vec2 point : {Vec2{1.2, .1}, Vec2{1.7, .1}}) {
    EXPECT_EQ(geometry.foot(first, point).inside, point.x < 1.5);
    EXPECT_EQ(geometry.foot(second, point).inside, point.x > 1.5);
    EXPECT_EQ(geometry.foot(first, point).gap, geometry.foot(second, point).gap);
  }
}

TEST(Relink, ContactTakesTwoHalvesBetweenCorners) {
  CutMesh mesh = square(4, {{2, 0}});
  const ComponentId finer(std::size_t{1});
  mesh.addBody(structuredRectangle({9, 0}, {10, 1}, 8, 8), finer, [](auto) { return false; });
  crack(mesh, {{{2, 0}, {2, 1}}});
  const EntryId first = firstAt(mesh, {1, 0}, {2, 0});
  const EntryId second = mesh.surfaces.next[first.value];
  Model model;
  Component component;
  component.selfContact = true;
  component.brittle.tensileStrength = 1;
  model.components = {component, Component{}};
  PassRule rule;
  rule.update(mesh.surfaces, mesh.positions, {.passes = 1});
  // Even the point at which two halves go straight on is a slave: the next crack may make it a
  // corner.
  const EntryId other = firstAt(mesh, {9, 0}, {9.125, 0});
  EXPECT_TRUE(rule.mayBeSlave(model, mesh.surfaces, second, other));
  EXPECT_TRUE(rule.mayBeSlave(model, mesh.surfaces, other, second));

  const std::vector<BoxPair> overlapping{orderedPair(BoxId(first.value), BoxId(second.value))};
  std::vector<SlaveMaster> pairs;
  selectPairs(model, mesh.surfaces, rule, mesh.positions, .1, overlapping, pairs);
  // The halfpoint is the first half's own end; the corner is not near the second half.
  EXPECT_TRUE(pairs.empty());
  // The two faces of the crack: each one's beginning is in the other's halo, as its end.
  const EntryId in = firstAt(mesh, {2, 0}, {2, 1});
  const EntryId out = firstAt(mesh, {2, 1}, {2, 0});
  const std::vector<BoxPair> faces{orderedPair(BoxId(in.value), BoxId(out.value))};
  selectPairs(model, mesh.surfaces, rule, mesh.positions, .1, faces, pairs);
  ASSERT_EQ(pairs.size(), 1U);  // not the tip, where the one ends and the other begins
  EXPECT_EQ(pairs[0], (SlaveMaster{in, out}));
}

TEST(Relink, CrackedBodyIsTakenAway) {
  for (const std::size_t gone : {0U, 1U}) {
    CutMesh mesh = square(4, {{2, 0}, {4, 2}});
    mesh.addBody(structuredRectangle({9, 0}, {12, 3}, 3, 3), ComponentId(std::size_t{1}),
                 [](CutMesh::Row node) { return node % 2 == 0; });
    crack(mesh, {{{2, 0}, {2, 1}}, {{2, 1}, {2, 2}}});
    crack(mesh, {{{10, 0}, {10, 1}}, {{2, 2}, {1, 2}}, {{12, 1}, {11, 1}}});
    ContactSurfaces s = mesh.surfaces;
    s.removeComponents({gone == 0, gone == 1});
    checkCrackedLinks(s);
    checkPiecesJoin(s);
    EXPECT_EQ(countLists(s.next), 1U);
  }
}

}  // namespace
}  // namespace yadefrag
