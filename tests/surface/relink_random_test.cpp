// Meshes that crack edge by edge until every triangle is on its own.

#include <gtest/gtest.h>
#include <algorithm>

#include <random>
#include <vector>

#include "cut_mesh_checks.hpp"
#include "meshing/structured.hpp"

namespace yadefrag {
namespace {

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
