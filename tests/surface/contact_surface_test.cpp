#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "cut_mesh.hpp"
#include "meshing/triangulate.hpp"
#include "surface/contact_surface.hpp"
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
    std::vector<std::uint8_t> isGone(3);
    isGone[gone.value] = 1;
    s.removeComponents(isGone);
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

// --- Meshes that crack edge by edge until every triangle is on its own.

using Side = CutMesh::Side;

/// Two bodies of all kinds of nodes.
CutMesh randomBodies(std::mt19937& random) {
  CutMesh mesh;
  const unsigned smoothOfEight = random() % 9;
  for (std::size_t body = 0; body < 2; ++body) {
    const int nx = 2 + static_cast<int>(random() % 8), ny = 2 + static_cast<int>(random() % 8);
    const auto pattern = random() % 2 == 0 ? QuadPattern::kUnionJack : QuadPattern::kCrossed;
    const double left = 20. * static_cast<double>(body);
    mesh.addBody(structuredRectangle({left, 0}, {left + nx, 1. * ny}, nx, ny, pattern),
                 ComponentId(body), [&](CutMesh::Row) { return random() % 8 < smoothOfEight; });
  }
  return mesh;
}

std::vector<Side> shuffledEdges(const CutMesh& mesh, std::mt19937& random) {
  std::vector<Side> edges;
  mesh.forEachSide(0, [&](Side side) {
    const Side other = mesh.at(mesh.across, side);
    if (other.triangle != CutMesh::kOutside && side.triangle < other.triangle)
      edges.push_back(side);
  });
  std::shuffle(edges.begin(), edges.end(), random);
  return edges;
}

void checkListed(const CutMesh& mesh, const std::vector<SurfaceSide>& sides,
                 std::size_t segmentsBefore) {
  std::size_t appended = segmentsBefore;
  for (const SurfaceSide& side : sides) {
    const bool isNew = side.segment == SegmentId::none();
    checkSide(mesh, isNew ? SegmentId(appended++) : side.segment, side.first, side.last);
    if (testing::Test::HasFatalFailure()) return;
  }
  ASSERT_EQ(appended, mesh.surfaces.segments());
}

/// Cracks all edges, one or a few at a time; returns how often it relinked.
std::size_t crackAll(std::mt19937& random) {
  CutMesh mesh = randomBodies(random);
  const std::vector<Side> edges = shuffledEdges(mesh, random);
  const std::size_t most = random() % 4 == 0 ? 6 : 1;
  const std::size_t often = 1 + random() % 400;  // how many times, about, until all is checked
  std::size_t times = 0;
  checkMesh(mesh);
  for (std::size_t i = 0; i < edges.size() && !testing::Test::HasFatalFailure();) {
    const std::size_t count = std::min(edges.size() - i, 1 + random() % most);
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(i);
    const std::vector<Side> next(first, first + static_cast<std::ptrdiff_t>(count));
    i += count;
    const bool all = random() % often == 0;
    const ContactSurfaces before = all ? mesh.surfaces : ContactSurfaces();
    const std::size_t segments = mesh.surfaces.segments(), nodes = mesh.positions.size();
    const std::vector<SurfaceSide> sides = mesh.crack(next);
    times += sides.empty() ? 0 : 1;
    const std::vector<EntryId> straightened = relink(mesh.surfaces, sides);
    // New nodes move apart, so that it shows if a piece is on the wrong one.
    for (std::size_t n = nodes; n < mesh.positions.size(); ++n)
      mesh.positions[n] += Vec2{.001 * (random() % 100), .001 * (random() % 100)};
    checkListed(mesh, sides, segments);
    if (!all || testing::Test::HasFatalFailure()) continue;
    checkOnlyAppended(before, mesh.surfaces, sides, straightened);
    if (!testing::Test::HasFatalFailure()) checkMesh(mesh);
  }
  if (testing::Test::HasFatalFailure()) return times;
  checkMesh(mesh);
  EXPECT_EQ(countPieces(mesh), mesh.triangles.size());
  EXPECT_EQ(countLists(mesh.surfaces.next), mesh.triangles.size());
  EXPECT_EQ(mesh.positions.size(), 3 * mesh.triangles.size());
  return times;
}

TEST(RelinkRandom, MeshesCrackToPieces) {
  std::mt19937 random(11);
  std::size_t times = 0;
  while (times < 100000 && !HasFatalFailure()) times += crackAll(random);
}

}  // namespace
}  // namespace yadefrag
