// The paper's figures. Counting rules: core/comparisons.hpp. The scene of appendix A: N = n² nodes
// in a square, one per unit of area, position-code boxes of edge b.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/tolerances/search.hpp"
#include "search/contact_search.hpp"

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

TEST(PaperFigures, FlatPerNodeFromAThousandToAMillion) {
  std::vector<double> perNode;
  for (const std::size_t count : {1000, 10000, 100000, 1000000}) {
    Nodes nodes(count);
    const auto search = makeSearch(SearchMethod::kLebesgue, true);
    ofOneSearch(*search, nodes.boxes());
    nodes.move(.1);
    perNode.push_back(static_cast<double>(ofOneSearch(*search, nodes.boxes()).total()) /
                      static_cast<double>(count));
  }
  // The square fills more or less of the power of four above it, which moves single figures by a
  // tenth; growth with log N would double them. The smallest scene has a rim of 13 % of its nodes,
  // with fewer neighbours.
  EXPECT_NEAR(perNode[1] / perNode[3], 1, .1);
  EXPECT_NEAR(perNode[2] / perNode[3], 1, .1);
  EXPECT_LT(perNode[0], perNode[3]);
  EXPECT_GT(perNode[0], .75 * perNode[3]);
}

TEST(PaperFigures, RivalsNeedMoreAndGrow) {
  // §4.5: LPC pays log N per row, ten comparisons more for a thousand times the nodes, of some
  // thirty in all; HO descends a tree of log N levels.
  std::vector<double> lebesgue, linear, hierarchy;
  for (const std::size_t count : {1000, 1000000}) {
    for (auto& [method, result] : {std::pair{SearchMethod::kLebesgue, &lebesgue},
                                   {SearchMethod::kLinearCode, &linear},
                                   {SearchMethod::kHierarchy, &hierarchy}}) {
      Nodes nodes(count);
      const auto search = makeSearch(method, true);
      ofOneSearch(*search, nodes.boxes());
      nodes.move(.1);
      result->push_back(static_cast<double>(ofOneSearch(*search, nodes.boxes()).total()) /
                        static_cast<double>(count));
    }
  }
  EXPECT_GT(linear[1], 1.1 * linear[0]);
  EXPECT_GT(hierarchy[1], 1.2 * hierarchy[0]);
  EXPECT_LT(lebesgue[1], linear[1]);
  EXPECT_LT(lebesgue[1], hierarchy[1]);
}

TEST(PaperFigures, CountingIsOffByDefault) {
  const Nodes nodes(1000);
  const auto search = makeSearch(SearchMethod::kLebesgue);
  EXPECT_EQ(ofOneSearch(*search, nodes.boxes()).total(), 0U);
}

}  // namespace
}  // namespace yadefrag
