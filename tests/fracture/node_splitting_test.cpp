// Bodies that crack edge by edge, at random, until every triangle is on its own.

#include "fracture/fracture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/checks.hpp"
#include "fracture/random_cracks.hpp"

namespace yadefrag::test {
namespace {

/// What a crack does to a scene, as `World` does it.
std::vector<EntryId> crackEdges(World& world, std::vector<EdgeId> batch, SplitResult& result) {
  std::sort(batch.begin(), batch.end());
  splitNodes(world.model, world.fracture.edges, world.surfaces, batch, result);
  world.contact.resize(world.model.nodes.size());
  return relink(world.surfaces, result.sides);
}

void checkAll(const World& world) { checkLaws(world.model, world.fracture.edges, world.surfaces); }

bool isOnSurface(const ContactSurfaces& surfaces, NodeId node) {
  return node.value < surfaces.nodeSegment.size() &&
         surfaces.nodeSegment[node.value] != SegmentId::none();
}

/// The report of a split against the scene before (`model`, `surfaces`) and after.
void checkReport(const Model& model, const ContactSurfaces& surfaces, const World& after,
                 const SplitResult& result) {
  const Nodes& nodes = after.model.nodes;
  const std::size_t first = model.nodes.size();
  ASSERT_EQ(nodes.size(), first + result.originals.size());
  for (std::size_t i = 0; i < result.originals.size(); ++i) {
    const std::uint32_t original = result.originals[i].value;
    ASSERT_LT(original, first);
    ASSERT_TRUE(nodes.position[first + i] == model.nodes.position[original] &&
                nodes.velocity[first + i] == model.nodes.velocity[original] &&
                nodes.held[first + i] == model.nodes.held[original] &&
                nodes.component[first + i] == model.nodes.component[original]);
    ASSERT_EQ(after.model.nodes.reference[first + i], after.model.nodes.reference[original]);
  }
  std::vector<ElementId> changed;
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    for (std::size_t c = 0; c < 3; ++c) {
      const NodeId was = model.triangles.nodes[e][c], is = after.model.triangles.nodes[e][c];
      if (was == is) continue;
      ASSERT_EQ(was, result.originals[is.value - first]);
      if (changed.empty() || changed.back() != ElementId(e)) changed.emplace_back(e);
    }
  ASSERT_EQ(result.changed, changed);
  std::vector<NodeId> shown;
  for (std::size_t n = 0; n < first; ++n)
    if (isOnSurface(after.surfaces, NodeId(n)) && !isOnSurface(surfaces, NodeId(n)))
      shown.emplace_back(n);
  ASSERT_EQ(result.onSurface, shown);
  // What has been split is a corner.
  for (std::size_t i = 0; i < result.originals.size(); ++i)
    for (const NodeId node : {result.originals[i], NodeId(first + i)})
      if (isOnSurface(after.surfaces, node)) {
        ASSERT_FALSE(after.surfaces.isSmooth(after.surfaces.nodeSegment[node.value]));
      }
}

/// What is left of the edges when a body is gone, in order.
using EdgeRecord = std::tuple<double, double, double, double, double, int>;
std::vector<EdgeRecord> recordsWithout(const World& world, ComponentId gone) {
  std::vector<EdgeRecord> records;
  const CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Side side = edges.side(EdgeId(i), 0);
    if (world.model.triangles.component[side.element.value] == gone) continue;
    const Vec2 a = world.model.nodes.position[firstNode(world.model, side).value];
    const Vec2 b = world.model.nodes.position[lastNode(world.model, side).value];
    records.emplace_back(a.x, a.y, b.x, b.y, edges.strength[i], edges.cracked[i]);
  }
  return records;
}

void removeOne(World& world, RandomCracks& random) {
  std::vector<ComponentId> present;
  for (std::size_t c = 0; c < world.model.components.size(); ++c)
    if (world.model.components[c].firstTriangle != world.model.components[c].lastTriangle)
      present.emplace_back(c);
  if (present.size() < 2) return;
  const ComponentId gone = present[static_cast<std::size_t>(below(random, 1000)) % present.size()];
  const std::vector<EdgeRecord> expected = recordsWithout(world, gone);
  world.removeBody(gone);
  ASSERT_EQ(recordsWithout(world, gone), expected);
  ASSERT_EQ(world.model.nodes.reference.size(), world.model.nodes.size());
  checkAll(world);
}

/// Returns how many edges cracked.
std::size_t crackToPieces(RandomCracks& random) {
  World world;
  fill(world, random);
  checkAll(world);
  const int most = random() % 4 == 0 ? 40 : 1 + below(random, 4);
  const unsigned often = 1 + random() % 100;  // batches, about, until all is looked at
  std::size_t cracked = 0;
  SplitResult result;
  Sums sums = sumsOf(world.model);
  std::vector<EdgeId> left = shuffledEdges(world.fracture.edges, random);
  while (!left.empty() && !testing::Test::HasFailure()) {
    const auto count = std::min(left.size(), static_cast<std::size_t>(1 + below(random, most)));
    const std::vector<EdgeId> batch(left.end() - static_cast<std::ptrdiff_t>(count), left.end());
    left.resize(left.size() - count);
    cracked += count;
    const bool all = random() % often == 0;
    const Model model = all ? world.model : Model();
    const ContactSurfaces surfaces = all ? world.surfaces : ContactSurfaces();
    const std::vector<EntryId> straightened = crackEdges(world, batch, result);
    if (!all) continue;
    checkReport(model, surfaces, world, result);
    checkOnlyAppended(surfaces, world.surfaces, result.sides, straightened);
    expectKept(sums, sumsOf(world.model));
    if (!testing::Test::HasFatalFailure()) checkAll(world);
    if (random() % 40 != 0 || testing::Test::HasFatalFailure()) continue;
    removeOne(world, random);
    sums = sumsOf(world.model);
    left = shuffledEdges(world.fracture.edges, random);
  }
  if (testing::Test::HasFailure()) return cracked;
  checkAll(world);
  expectKept(sums, sumsOf(world.model));
  std::map<std::uint32_t, int> corners;
  for (std::size_t e = 0; e < world.model.triangles.size(); ++e)
    if (world.model.components[world.model.triangles.component[e].value].brittle.cracks())
      for (const NodeId node : world.model.triangles.nodes[e]) ++corners[node.value];
  for (const auto& [node, count] : corners) EXPECT_EQ(count, 1) << node;
  return cracked;
}

TEST(NodeSplitting, BodiesCrackToPiecesAndEveryLawHolds) {
  RandomCracks random(5);
  std::size_t cracked = 0;
  while (cracked < 100000 && !HasFailure()) cracked += crackToPieces(random);
  RecordProperty("cracked", static_cast<int>(cracked));
}

/// Are the same corners of triangles the same node, whatever its number, of the same mass?
void expectSamePartition(const Model& a, const Model& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  std::vector<NodeId> inB(a.nodes.size(), NodeId::none());
  for (std::size_t e = 0; e < a.triangles.size(); ++e)
    for (std::size_t c = 0; c < 3; ++c) {
      const NodeId here = a.triangles.nodes[e][c], there = b.triangles.nodes[e][c];
      if (inB[here.value] == NodeId::none()) inB[here.value] = there;
      ASSERT_EQ(inB[here.value], there);
      ASSERT_NEAR(a.nodes.mass[here.value] / b.nodes.mass[there.value], 1, 1e-14);
    }
}

// A batch gives the same pieces as its edges one by one: only the numbers of nodes and segments
// depend on the order.
TEST(NodeSplitting, ABatchIsItsEdgesOneByOne) {
  RandomCracks random(9);
  for (int scene = 0; scene < 60 && !HasFailure(); ++scene) {
    World world, single;
    RandomCracks same = random;
    fill(single, same);
    fill(world, random);
    SplitResult result;
    std::vector<EdgeId> left = shuffledEdges(world.fracture.edges, random);
    while (!left.empty() && !HasFailure()) {
      const auto count = std::min(left.size(), static_cast<std::size_t>(1 + below(random, 90)));
      std::vector<EdgeId> batch(left.end() - static_cast<std::ptrdiff_t>(count), left.end());
      left.resize(left.size() - count);
      crackEdges(world, batch, result);
      for (const EdgeId edge : batch) crackEdges(single, {edge}, result);
      expectSamePartition(world.model, single.model);
      EXPECT_EQ(world.surfaces.segments(), single.surfaces.segments());
      EXPECT_EQ(countLists(world.surfaces.segmentNext), countLists(single.surfaces.segmentNext));
      checkAll(world);
    }
  }
}

}  // namespace
}  // namespace yadefrag::test
