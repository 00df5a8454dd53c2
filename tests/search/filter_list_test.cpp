// Filter boxes: what they exclude and what they decide, the two layouts against a plain loop, and
// the instruction sets.

#include "search/filter_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "search/filter_blocks.hpp"

namespace yadefrag {
namespace {

/// Boxes on a coarse grid, so that many touch exactly; some differ in the last bits only.
std::vector<Box> touchingBoxes(std::mt19937_64& random, std::size_t count) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>(random() % 8) / 3;
      box.max[axis] = box.min[axis] + static_cast<double>(random() % 4) / 3;
      if (random() % 2) box.max[axis] = std::nextafter(box.max[axis], 10);
    }
  return boxes;
}

constexpr FilterScale kScale{{.1, -2, 1e3}, .7};

TEST(FilterBox, ExcludesAndDecidesCorrectly) {
  std::mt19937_64 random(1);
  const std::vector<Box> boxes = touchingBoxes(random, 600);
  int excluded = 0, decided = 0, open = 0;
  for (const Box& a : boxes)
    for (const Box& b : boxes) {
      const FilterBox fa = FilterBox::of(a, kScale), fb = FilterBox::of(b, kScale);
      const bool may = mayOverlap(fa, fb), sure = surelyOverlap(fa, fb);
      if (overlaps(a, b))
        ASSERT_TRUE(may);
      else
        ASSERT_FALSE(sure);
      ++(sure ? decided : may ? open : excluded);
    }
  EXPECT_GT(excluded, 1000);
  EXPECT_GT(decided, 1000);
  EXPECT_GT(open, 1000);
}

template <class Filters>
std::vector<std::size_t> nearOnes(const Filters& filters, const FilterBox& box,
                                  const std::vector<std::uint64_t>& codes, std::size_t begin,
                                  std::uint64_t start, std::uint64_t stop) {
  std::vector<std::size_t> found;
  filters.forEachNear(box, codes.data(), begin, start, stop,
                      [&](std::size_t j) { found.push_back(j); });
  return found;
}

/// Each third box has another code.
std::vector<std::uint64_t> codesOf(const std::vector<Box>& boxes) {
  std::vector<std::uint64_t> codes;
  for (std::size_t i = 0; i < boxes.size(); ++i) codes.push_back(i / 3 * 2);
  codes.insert(codes.end(), FilterBlocks::kTogether, ~std::uint64_t{0});
  return codes;
}

template <class Filters>
Filters filtersOf(const std::vector<Box>& boxes) {
  Filters filters;
  filters.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) filters.set(i, FilterBox::of(boxes[i], kScale));
  return filters;
}

TEST(FilterBox, BothLayoutsVisitTheSameBoxesOfARange) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Box> boxes = touchingBoxes(random, 1 + random() % 60);
    const std::vector<std::uint64_t> codes = codesOf(boxes);
    const auto list = filtersOf<FilterList>(boxes);
    const auto blocks = filtersOf<FilterBlocks>(boxes);
    const FilterBox box = FilterBox::of(boxes[random() % boxes.size()], kScale);
    const std::size_t begin = random() % boxes.size();
    const std::uint64_t stop = random() % 45;
    std::vector<std::size_t> wanted;
    for (std::size_t j = begin; j < boxes.size() && codes[j] <= stop; ++j)
      if (mayOverlap(box, list[j])) wanted.push_back(j);
    EXPECT_EQ(nearOnes(list, box, codes, begin, 0, stop), wanted);
    EXPECT_EQ(nearOnes(blocks, box, codes, begin, 0, stop), wanted);
    // Blocks may begin before the range: what has a lower code does not count.
    const std::size_t early = begin / FilterBlocks::kTogether * FilterBlocks::kTogether;
    std::vector<std::size_t> all;
    for (std::size_t j = early; j < boxes.size() && codes[j] <= stop; ++j)
      if (codes[j] >= codes[begin] && mayOverlap(box, list[j])) all.push_back(j);
    EXPECT_EQ(nearOnes(blocks, box, codes, early, codes[begin], stop), all);
  }
}

TEST(FilterBox, EveryInstructionSetCollectsTheSameBoxes) {
  std::mt19937_64 random(3);
  NearList near;
  std::size_t most = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Box> boxes = touchingBoxes(random, 1 + random() % 600);
    const std::vector<std::uint64_t> codes = codesOf(boxes);
    const auto blocks = filtersOf<FilterBlocks>(boxes);
    const FilterBox box = FilterBox::of(boxes[random() % boxes.size()], kScale);
    std::vector<BlockRange> ranges;
    std::vector<std::size_t> wanted;
    for (std::uint64_t k = random() % 6; k > 0; --k) {
      const std::size_t begin = random() % boxes.size();
      ranges.push_back({begin, {codes[begin] + random() % 2, random() % 450}});
      const BlockRange& range = ranges.back();
      for (const std::size_t j :
           nearOnes(blocks, box, codes, begin, range.codes.start, range.codes.stop))
        wanted.push_back(j);
    }
    for (const InstructionSet set : {InstructionSet::kBaseline, bestInstructionSet()}) {
      blocks.collectNear(set, box, codes.data(), ranges, near);
      const auto found = near.all();
      EXPECT_EQ(std::vector<std::size_t>(found.begin(), found.end()), wanted);
    }
    most = std::max(most, wanted.size());
  }
  EXPECT_GT(most, 50);
}

}  // namespace
}  // namespace yadefrag
