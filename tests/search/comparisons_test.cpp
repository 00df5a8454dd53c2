// The paper's figures. Counting rules: core/comparisons.hpp. The scene of appendix A: N = n² nodes
// in a square, one per unit of area, position-code boxes of edge b. The level that most boxes
// share, from which codes row by row are planned.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/tolerances/search.hpp"
#include "search/contact_search.hpp"
#include "search/curve_key.hpp"
#include "search/partner_table.hpp"
#include "search/search_plan.hpp"

namespace yadefrag {
namespace {

/// Of a position-code box, with halos of .5; a little more, so that every node changes its box.
constexpr double kEdge = .5 * tolerance::kSpareSide * tolerance::kEdgeOverExtent * (1 + 1e-9);

class Nodes {
 public:
  explicit Nodes(std::size_t count) {
    const double side = std::sqrt(static_cast<double>(count));
    std::uniform_real_distribution<double> place(0, side);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = place(random_), y = place(random_);
      // Halos of .5 around the nodes.
      boxes_.push_back({{x, y, 0}, {x + .5, y + .5, 0}});
    }
  }
  /// Every node goes up to `most` in each direction.
  void move(double most) {
    std::uniform_real_distribution<double> by(-most, most);
    for (Box& box : boxes_)
      for (int axis = 0; axis < 2; ++axis) {
        const double d = by(random_);
        box.min[axis] += d;
        box.max[axis] += d;
      }
  }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  std::mt19937_64 random_{21};
  std::vector<Box> boxes_;
};

Comparisons ofOneSearch(ContactSearch& search, const std::vector<Box>& boxes) {
  const Comparisons before = search.comparisons();
  std::vector<BoxPair> pairs;
  search.update(boxes);
  search.findPairs(pairs);
  Comparisons after = search.comparisons();
  after.move -= before.move;
  after.resort -= before.resort;
  after.range -= before.range;
  after.test -= before.test;
  return after;
}

TEST(PaperFigures, FourComparisonsForANodeThatStays) {
  const Nodes nodes(10000);
  const auto search = makeSearch(SearchMethod::kLebesgue, true);
  ofOneSearch(*search, nodes.boxes());
  EXPECT_EQ(ofOneSearch(*search, nodes.boxes()).move, 4U * 10000U);
  EXPECT_EQ(ofOneSearch(*search, nodes.boxes()).resort, 0U);
  const auto uncounted = makeSearch(SearchMethod::kLebesgue);
  EXPECT_EQ(ofOneSearch(*uncounted, nodes.boxes()).total(), 0U) << "counting is off by default";
}

TEST(PaperFigures, AtMostEightForANodeThatMoves) {
  // Lemma A.1: 4 + 2 · Σ (i + 1)/2^(i+1) = 8 where both boundaries are crossed; all cross here.
  Nodes nodes(100000);
  const auto search = makeSearch(SearchMethod::kLebesgue, true);
  ofOneSearch(*search, nodes.boxes());
  std::vector<Box> moved = nodes.boxes();
  for (Box& box : moved)
    for (int axis = 0; axis < 2; ++axis) {
      box.min[axis] += kEdge;
      box.max[axis] += kEdge;
    }
  const double perNode = static_cast<double>(ofOneSearch(*search, moved).move) / 100000;
  EXPECT_LE(perNode, 8.02);  // 8 in the limit of infinitely many levels, plus the sampling error
  EXPECT_GT(perNode, 7.9);
}

/// Of one search, after all nodes have gone up to .1.
double perNode(SearchMethod method, std::size_t count) {
  Nodes nodes(count);
  const auto search = makeSearch(method, true);
  ofOneSearch(*search, nodes.boxes());
  nodes.move(.1);
  return static_cast<double>(ofOneSearch(*search, nodes.boxes()).total()) /
         static_cast<double>(count);
}

TEST(PaperFigures, FlatPerNodeFromAThousandToAMillionWhereRivalsNeedMoreAndGrow) {
  const double million = perNode(SearchMethod::kLebesgue, 1000000);
  const double thousand = perNode(SearchMethod::kLebesgue, 1000);
  // The square fills more or less of the power of four above it, which moves single figures by a
  // tenth; growth with log N would double them. The smallest scene has a rim of 13 % of its nodes,
  // with fewer neighbours.
  for (const std::size_t count : {10000, 100000})
    EXPECT_NEAR(perNode(SearchMethod::kLebesgue, count) / million, 1, .1);
  EXPECT_LT(thousand, million);
  EXPECT_GT(thousand, .75 * million);
  // §4.5: LPC pays log N per row, ten comparisons more for a thousand times the nodes, of some
  // thirty in all; HO descends a tree of log N levels.
  for (const auto& [method, growth] :
       {std::pair{SearchMethod::kLinearCode, 1.1}, {SearchMethod::kHierarchy, 1.2}}) {
    const double many = perNode(method, 1000000);
    EXPECT_GT(many, growth * perNode(method, 1000));
    EXPECT_LT(million, many);
  }
}

/// Boxes with sides from 1 to `ratio`, with a density proportional to side^-power.
std::vector<Box> boxesOfSizes(double power, double ratio) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> part(0, 1), place(0, 500);
  std::vector<Box> boxes(5000);
  for (Box& box : boxes) {
    const double e = 1 - power;
    const double side = e == 0 ? std::pow(ratio, part(random))
                               : std::pow(1 + part(random) * (std::pow(ratio, e) - 1), 1 / e);
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + side;
    }
  }
  return boxes;
}

double partOnLevel(const std::vector<Box>& boxes, double extent) {
  const auto count = std::ranges::count_if(boxes, [&](const Box& box) {
    return longestSide(box) <= extent && longestSide(box) > extent / 2;
  });
  return static_cast<double>(count) / static_cast<double>(boxes.size());
}

TEST(SearchPlan, TakesTheLevelOfMostBoxes) {
  // Of radii with equal volume per octave 7/8 are in the first octave; its end is cut by the
  // margin.
  const std::vector<Box> boxes = boxesOfSizes(4, 20);
  const SearchPlan plan = planSearch(boxes, tolerance::kEven);
  EXPECT_TRUE(plan.isEven);
  EXPECT_GT(partOnLevel(boxes, plan.extent), .8);
  const SearchPlan ofMedian = planSearch(boxes);
  EXPECT_FALSE(ofMedian.isEven);
  EXPECT_LT(partOnLevel(boxes, ofMedian.extent), .5);
}

TEST(SearchPlan, IsNotEvenIfNoLevelHasEnoughBoxes) {
  const std::vector<Box> boxes = boxesOfSizes(1, 1000);
  EXPECT_FALSE(planSearch(boxes, tolerance::kEven).isEven);
  EXPECT_TRUE(planSearch(boxes, .05).isEven);
}

TEST(SearchPlan, KeepsALevelThatServesAboutAsManyBoxes) {
  std::vector<Box> boxes = boxesOfSizes(1, 10);
  const double extent = planSearch(boxes, tolerance::kEven).extent;
  EXPECT_EQ(planSearch(boxes, tolerance::kEven, 1.1 * extent).extent, 1.1 * extent);
  for (Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) box.max[axis] += 19 * (box.max[axis] - box.min[axis]);
  EXPECT_GT(planSearch(boxes, tolerance::kEven, extent).extent, 1.1 * extent);
}

// --- curve key

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Box cube(double x, double y, double z) { return {{x, y, z}, {x + 1, y + 1, z + 1}}; }

/// Boxes on a grid of 8 × 8 × `high` places, 1.1 m from each other: the edge of a position-code
/// box.
std::vector<Box> grid(int high) {
  std::vector<Box> boxes;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < high; ++z) boxes.push_back(cube(1.1 * x, 1.1 * y, 1.1 * z));
  return boxes;
}

TEST(CurveKey, IsThePositionCodeOfTheLowerCorner) {
  const std::vector<Box> space = grid(8), plane = grid(1);
  const CurveKey inSpace(space), inPlane(plane);
  for (std::uint32_t x = 0; x < 8; ++x)
    for (std::uint32_t y = 0; y < 8; ++y) {
      const Box box = cube(1.1 * x + .1, 1.1 * y + .1, .1);
      EXPECT_EQ(inPlane(box), PositionCode<2>::encode({x, y}));
      EXPECT_EQ(inSpace(box), PositionCode<3>::encode({x, y, 0}));
    }
}

TEST(CurveKey, TakesTheNearestPlaceForBoxesOutside) {
  const std::vector<Box> boxes = grid(8);
  const CurveKey key(boxes);
  EXPECT_EQ(key(cube(-1e300, .1, .1)), key(cube(.1, .1, .1)));
  constexpr std::uint32_t last = PositionCode<3>::kMask;
  EXPECT_EQ(key(cube(1e300, 1e300, 1e300)), PositionCode<3>::encode({last, last, last}));
  EXPECT_EQ(key({{-kInfinite, .1, .1}, {kInfinite, 1, 1}}), key(cube(.1, .1, .1)));
}

// Without any box with a finite side there is no plan; the order does not matter then.
TEST(CurveKey, NeedsNoFiniteBox) {
  const std::vector<Box> walls(2, Box{{-kInfinite, 0, 0}, {kInfinite, 1, 1}});
  EXPECT_EQ(CurveKey(walls)(walls[0]), CurveKey(walls)(walls[1]));
  EXPECT_EQ(CurveKey(std::span<const Box>())(cube(0, 0, 0)), 0U);
}

// --- partner table

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

PartnerTable tableOf(const Pairs& pairs, std::size_t rows) {
  PartnerTable table;
  table.build(
      rows, pairs.size(), [&](std::size_t i) { return pairs[i].first; },
      [&](std::size_t i) { return pairs[i].second; });
  return table;
}

TEST(PartnerTable, FindsEveryIndexOfAPairAndNoOther) {
  std::mt19937 random(1);
  for (const std::uint32_t rows : {1U, 3U, 40U}) {
    Pairs pairs;
    for (int i = 0; i < 400; ++i) pairs.emplace_back(random() % rows, random() % 50);
    const PartnerTable table = tableOf(pairs, rows);
    for (std::uint32_t first = 0; first < rows + 2; ++first)
      for (std::uint32_t second = 0; second < 52; ++second) {
        std::vector<std::uint32_t> expected, found;
        for (std::uint32_t i = 0; i < pairs.size(); ++i)
          if (pairs[i] == std::pair(first, second)) expected.push_back(i);
        table.forEach(first, second, [&](std::uint32_t i) { found.push_back(i); });
        ASSERT_EQ(found, expected) << first << ' ' << second;
      }
  }
}

/// A floor with the lowest id is the first member of all its pairs.
TEST(PartnerTable, AFloorUnderManySpheresIsNotQuadratic) {
  constexpr std::uint32_t spheres = 100000;
  Pairs pairs;
  for (std::uint32_t i = 1; i <= spheres; ++i) pairs.emplace_back(0, i);
  const PartnerTable table = tableOf(pairs, spheres + 1);
  std::size_t comparisons = 0, found = 0;
  for (std::uint32_t i = 1; i <= spheres; ++i)
    comparisons += table.forEach(0, i, [&](std::uint32_t) { ++found; });
  EXPECT_EQ(found, spheres);
  EXPECT_LT(comparisons, std::size_t{20} * spheres);  // one look at each partner made it 10¹⁰
}

}  // namespace
}  // namespace yadefrag
