// Sorted lists of codes and their comparisons. Filter boxes: what they exclude and decide, and the
// instruction sets. Pairs against brute force: search_property_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/comparisons.hpp"
#include "search/code_directory.hpp"
#include "search/filter_blocks.hpp"
#include "search/filter_box.hpp"
#include "search/numbering.hpp"
#include "search/row_begins.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {
namespace {

TEST(CodeDirectory, LooksDoNotGrowWithTheList) {
  std::mt19937_64 random(4);
  for (const bool isClustered : {false, true}) {
    std::vector<double> perLook;
    for (const std::size_t count : {1000, 1000000}) {
      std::vector<std::uint64_t> codes(count);
      for (std::uint64_t& code : codes)
        code = isClustered ? (random() % 2 << 60) + random() % (count * 10) : random() >> 1;
      std::sort(codes.begin(), codes.end());
      CodeDirectory directory;
      directory.build(codes);
      Count counted(true);
      for (std::size_t i = 0; i < 10000; ++i)
        static_cast<void>(directory.lowerBound(codes[random() % count] + random() % 3, counted));
      perLook.push_back(static_cast<double>(counted.total().range) / 10000);
    }
    EXPECT_LT(perLook[1], 1.3 * perLook[0]);
    EXPECT_LT(perLook[1], 9);
  }
}

// --- sorted list

std::vector<CodedSlot> randomList(std::mt19937_64& random, std::size_t count, std::uint64_t most) {
  std::vector<CodedSlot> list(count);
  for (std::size_t i = 0; i < count; ++i)
    list[i] = {random() % most, static_cast<std::uint32_t>(i)};
  return list;
}

bool same(const std::vector<CodedSlot>& a, const std::vector<CodedSlot>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](auto& x, auto& y) { return x.code == y.code && x.slot == y.slot; });
}

TEST(SortedList, RadixSortIsASort) {
  std::mt19937_64 random(5);
  for (const std::size_t count : {0, 1, 255, 256, 5000})
    for (const std::uint64_t most : {1ULL, 7ULL, 100000ULL, 1ULL << 63}) {
      auto list = randomList(random, count, most);
      auto expected = list;
      std::sort(expected.begin(), expected.end());
      sortByCode(list);
      ASSERT_TRUE(same(list, expected)) << count << " codes below " << most;
    }
}

TEST(SortedList, ComparisonsOfAnInsertionDoNotGrowWithTheList) {
  // Lemma A.2: a constant number per entry that moved, here a tenth of them all.
  std::mt19937_64 random(8);
  std::vector<double> perMoved;
  for (const std::size_t count : {1000, 1000000}) {
    auto entries = randomList(random, count, 1ULL << 40);
    auto incoming = randomList(random, count / 10, 1ULL << 40);
    sortByCode(entries);
    sortByCode(incoming);
    SortedList list;
    Count uncounted;
    list.insert(entries, uncounted);
    Count counted(true);
    list.insert(incoming, counted);
    perMoved.push_back(static_cast<double>(counted.total().resort) /
                       (static_cast<double>(count) / 10));
  }
  EXPECT_LT(perMoved[1], 1.1 * perMoved[0]);
  EXPECT_LT(perMoved[1], 10);
}

/// Lemma A.3 with neighbours in the order of the sweep: a constant number of steps for each.
TEST(RowBegins, AdvanceInAFewStepsEach) {
  std::mt19937_64 random(4);
  Count counted(true);
  constexpr std::size_t kCodes = 100000;
  std::vector<std::uint64_t> codes(kCodes);
  for (std::uint64_t& code : codes) code = random() % (3 * kCodes);
  std::sort(codes.begin(), codes.end());
  codes.push_back(~std::uint64_t{0});
  RowBegins::OfLevel places;
  for (std::size_t i = 0; i < kCodes; ++i) places.lowerBound(0, codes, codes[i] + 500, counted);
  EXPECT_LE(counted.total().range, 3 * kCodes);
}

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

/// Each third box has another code.
TEST(FilterBox, EveryInstructionSetCollectsTheSameBoxes) {
  std::mt19937_64 random(3);
  NearList near;
  std::size_t most = 0;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Box> boxes = touchingBoxes(random, 1 + random() % 600);
    std::vector<std::uint64_t> codes;
    FilterBlocks blocks;
    blocks.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      codes.push_back(i / 3 * 2);
      blocks.set(i, FilterBox::of(boxes[i], kScale));
    }
    codes.insert(codes.end(), FilterBlocks::kTogether, ~std::uint64_t{0});
    const FilterBox box = FilterBox::of(boxes[random() % boxes.size()], kScale);
    std::vector<BlockRange> ranges;
    std::vector<std::size_t> wanted;
    for (std::uint64_t k = random() % 6; k > 0; --k) {
      const std::size_t begin = random() % boxes.size();
      ranges.push_back({begin, {codes[begin] + random() % 2, random() % 450}});
      const auto& range = ranges.back().codes;
      blocks.forEachNear(box, codes.data(), begin, range.start, range.stop,
                         [&](std::size_t j) { wanted.push_back(j); });
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
