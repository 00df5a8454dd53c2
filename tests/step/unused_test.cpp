// What a scene does not use has no arrays: 0 bytes. Each test has a counterpart that uses it.

#include <gtest/gtest.h>
#include <malloc.h>
#include <algorithm>

#include <memory>

#include "search/code_search.hpp"
#include "step/unused_scenes.hpp"

namespace yadefrag::test {
namespace {

/// A world that has run long enough for its rings to meet.
struct Ringing {
  World world;
  std::size_t mostRows = 0;

  explicit Ringing(const Uses& uses, int rings = 4, int steps = 80) {
    addRings(world, rings, uses);
    const double dt = (uses.cohesion ? .2 : .8) * world.criticalTimeStep();
    for (int i = 0; i < steps; ++i) {
      world.step(dt);
      mostRows = std::max(mostRows, world.contact.rows().size());
    }
  }
  [[nodiscard]] std::size_t bytes(Use use) const { return world.footprint().of(use); }
};

struct Feature {
  const char* name;
  Use use;
};

class Unused : public ::testing::TestWithParam<Feature> {};

TEST_P(Unused, HasNoArrays) {
  const auto [name, use] = GetParam();
  const Ringing without({});
  EXPECT_GT(without.mostRows, 0U);
  EXPECT_EQ(without.bytes(use), 0U);
  Uses one;
  ASSERT_TRUE(one.turnOn(name));
  const Ringing with(one);
  EXPECT_GT(with.mostRows, 0U);
  EXPECT_GT(with.bytes(use), 0U);
}

TEST_P(Unused, HasNoArraysBesideAllTheOthers) {
  const auto [name, use] = GetParam();
  Uses others;
  for (const char* other : {"fracture", "cohesion", "friction", "smooth", "selfContact",
                            "viscosity", "held", "loads", "materials"})
    if (std::string(other) != name) others.turnOn(other);
  if (use == Use::kFracture) others.cohesion = false;
  EXPECT_EQ(Ringing(others).bytes(use), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Features, Unused,
    ::testing::Values(Feature{"fracture", Use::kFracture}, Feature{"cohesion", Use::kCohesion},
                      Feature{"smooth", Use::kSmooth}, Feature{"viscosity", Use::kViscosity},
                      Feature{"held", Use::kHeld}, Feature{"loads", Use::kLoads},
                      Feature{"materials", Use::kMaterials}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(UnusedContact, OneBodyThatCannotTouchItselfHasNone) {
  Uses uses;
  const Ringing alone(uses, 1);
  EXPECT_EQ(alone.bytes(Use::kSearch), 0U);
  EXPECT_EQ(alone.bytes(Use::kContact), 0U);
  EXPECT_EQ(alone.world.numSearches(), 0U);
  uses.selfContact = true;
  EXPECT_GT(Ringing(uses, 1).bytes(Use::kSearch), 0U);
}

TEST(UnusedContact, BodiesThatStayFarFromEachOtherHaveNoneButTheSearch) {
  World far;
  addFarBlocks(far, 3, 8);
  const double dt = .8 * far.criticalTimeStep();
  for (int i = 0; i < 80; ++i) far.step(dt);
  EXPECT_EQ(far.footprint().of(Use::kContact), 0U);
  EXPECT_EQ(far.contact.candidates.size(), 0U);
  EXPECT_GT(far.footprint().of(Use::kSearch), 0U);
  EXPECT_GT(Ringing({}).bytes(Use::kContact), 0U);
}

/// A tuning fork whose prongs close up, beside a block that comes near.
std::size_t candidatesOnOneBody(bool selfContact) {
  World world;
  const Polygon outline{{{0, 0},
                         {3e-3, 0},
                         {3e-3, 4e-3},
                         {1.6e-3, 4e-3},
                         {1.6e-3, 1e-3},
                         {1.4e-3, 1e-3},
                         {1.4e-3, 4e-3},
                         {0, 4e-3}},
                        {}};
  const TriangleMesh fork = triangulate(outline, .4e-3);
  BodySpec spec = fescenes::steelBody(fork, {});
  for (std::size_t i = 0; i < fork.nodes.size(); ++i)
    if (fork.nodes[i].y > 2e-3) spec.velocity[i].x = fork.nodes[i].x < 1.5e-3 ? 100 : -100;
  spec.selfContact = selfContact;
  world.addBody(fork, spec);
  const TriangleMesh block = structuredRectangle({0, -1.1e-3}, {1e-3, -.1e-3}, 3, 3);
  world.addBody(block, fescenes::steelBody(block, {0, 100}));
  const double dt = .8 * world.criticalTimeStep();
  for (int i = 0; i < 100; ++i) world.step(dt);
  const Candidates& c = world.contact.candidates;
  EXPECT_GT(c.size(), 0U);
  const std::vector<ComponentId>& body = world.surfaces.component;
  std::size_t count = 0;
  for (std::size_t r = 0; r < c.slaves.size(); ++r)
    for (std::uint32_t k = c.offsets[r]; k < c.offsets[r + 1]; ++k)
      count += body[c.slaves[r].value] == body[c.masters[k].value] ? 1 : 0;
  return count;
}

TEST(UnusedContact, BodiesThatCannotTouchThemselvesHaveNoCandidatesOfTheirOwn) {
  EXPECT_EQ(candidatesOnOneBody(false), 0U);
  EXPECT_GT(candidatesOnOneBody(true), 0U);
}

template <int Dim>
using Search = CodeSearch<LebesgueNumbering<Dim>, Dim, CountAll>;

/// Pairs of an array of squares in the plane z = 0.
template <int Dim>
std::vector<BoxPair> searchPlane(Search<Dim>& search, const std::vector<Box>& boxes) {
  std::vector<BoxPair> pairs;
  search.update(boxes);
  search.findPairs(pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// A scene in the plane has codes of two coordinates: the third costs nothing.
TEST(UnusedAxis, PlaneSceneComparesAndKeepsLessThanIn3dCodes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Box> boxes;
  for (int i = 0; i < 5000; ++i) {
    const double x = 60 * unit(random), y = 60 * unit(random);
    boxes.push_back({{x, y, 0}, {x + 1, y + 1, 0}});
  }
  const SearchPlan planned = planSearch(boxes);
  ASSERT_EQ(planned.dim, 2);
  SearchPlan inSpace = planned;
  inSpace.dim = 3;
  Search<2> plane(planned);
  Search<3> space(inSpace);
  EXPECT_EQ(searchPlane(plane, boxes), searchPlane(space, boxes));
  const Comparisons in2d = plane.comparisons(), in3d = space.comparisons();
  EXPECT_LT(in2d.test, in3d.test);
  EXPECT_LT(in2d.range, in3d.range);
  EXPECT_LE(in2d.move, in3d.move);
  Footprint bytes2d, bytes3d;
  plane.addTo(bytes2d);
  space.addTo(bytes3d);
  EXPECT_LE(bytes2d.total(), bytes3d.total());
}

std::size_t heapInUse() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// No array is missing: the growth of the heap equals the footprint.
TEST(Footprint, CountsNearlyAllMemory) {
  for (const char* used : {"", "fracture", "smooth", "viscosity"}) {
    Uses uses;
    uses.turnOn(used);
    const std::size_t before = heapInUse();
    if (before == 0) GTEST_SKIP() << "this allocator does not report the memory in use";
    const auto run = std::make_unique<Ringing>(uses, 20, 40);
    const auto grown = static_cast<double>(heapInUse() - before);
    EXPECT_NEAR(static_cast<double>(run->world.footprint().total()) / grown, 1, .02) << used;
  }
}

}  // namespace
}  // namespace yadefrag::test
