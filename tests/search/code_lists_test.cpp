// Sorted lists of codes. Filter boxes: what they exclude and what they decide, the two layouts
// against a plain loop, and the instruction sets.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/comparisons.hpp"
#include "curve/numbering.hpp"
#include "search/code_directory.hpp"
#include "search/filter_blocks.hpp"
#include "search/filter_box.hpp"
#include "search/row_begins.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {
namespace {

std::vector<std::uint64_t> codesOfKind(std::mt19937_64& random, int kind, std::size_t count) {
  std::vector<std::uint64_t> codes(count);
  for (std::uint64_t& code : codes) {
    switch (kind) {
      case 0:
        code = random() >> 1;
        break;  // even
      case 1:
        code = (random() % 2 << 60) + random() % 5000;
        break;  // two clusters
      case 2:
        code = random() % 4;
        break;  // many equal
      case 3:
        code = std::uint64_t{1} << (random() % 63);
        break;  // every scale
      default:
        code = random() % 3 ? 12345 : (random() >> 1);
        break;  // a crowd, outliers
    }
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

TEST(CodeDirectory, FindsWhatBinarySearchFinds) {
  std::mt19937_64 random(3);
  CountNothing nothing;
  for (int k = 0; k < 2000; ++k) {
    const auto codes = codesOfKind(random, k % 5, random() % 400);
    CodeDirectory directory;
    directory.build(codes);
    const auto check = [&](std::uint64_t code) {
      const auto expected = std::lower_bound(codes.begin(), codes.end(), code) - codes.begin();
      ASSERT_EQ(directory.lowerBound(code, nothing), expected);
    };
    check(0);
    check(~std::uint64_t{0});
    for (const std::uint64_t code : codes) {
      check(code);
      check(code + 1);
      check(code > 0 ? code - 1 : 0);
    }
    for (int i = 0; i < 50; ++i) check(random() >> (random() % 64));
  }
}

TEST(CodeDirectory, LooksDoNotGrowWithTheList) {
  std::mt19937_64 random(4);
  for (const int kind : {0, 1}) {
    std::vector<double> perLook;
    for (const std::size_t count : {1000, 1000000}) {
      auto codes = codesOfKind(random, kind, count);
      if (kind == 1)
        for (std::uint64_t& code : codes) code = (code >> 60 << 60) + random() % (count * 10);
      std::sort(codes.begin(), codes.end());
      CodeDirectory directory;
      directory.build(codes);
      CountAll counted;
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

/// A list with the given entries, which are sorted.
SortedList listOf(const std::vector<CodedSlot>& entries) {
  SortedList list;
  CountNothing uncounted;
  list.insert(entries, uncounted);
  return list;
}

bool same(const SortedList& list, const std::vector<CodedSlot>& entries) {
  bool all = list.size() == entries.size() && list.codes().back() == SortedList::kEnd;
  for (std::size_t i = 0; all && i < entries.size(); ++i)
    all = list.codes()[i] == entries[i].code && list.slot(i) == entries[i].slot;
  return all;
}

TEST(SortedList, InsertionIsASortOfBoth) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 2000; ++k) {
    const std::uint64_t most = k % 3 ? 1000000 : 10;
    auto all = randomList(random, random() % 300, most);
    std::vector<CodedSlot> entries;
    std::vector<CodedSlot> incoming;
    for (const CodedSlot& entry : all) (random() % 4 ? entries : incoming).push_back(entry);
    std::sort(entries.begin(), entries.end());
    std::sort(incoming.begin(), incoming.end());
    std::sort(all.begin(), all.end());
    SortedList list = listOf(entries);
    ASSERT_TRUE(same(list, entries));
    CountNothing nothing;
    list.insert(incoming, nothing);
    ASSERT_TRUE(same(list, all));
  }
}

TEST(SortedList, KeepsTheOrderOfWhatStays) {
  std::mt19937_64 random(7);
  auto entries = randomList(random, 500, 100);
  std::sort(entries.begin(), entries.end());
  SortedList list = listOf(entries);
  const auto leaves = [](std::uint32_t slot) { return slot % 3 == 0; };
  list.remove(leaves);
  std::erase_if(entries, [&](const CodedSlot& entry) { return leaves(entry.slot); });
  EXPECT_TRUE(same(list, entries));
  list.clear();
  EXPECT_TRUE(same(list, {}));
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
    SortedList list = listOf(entries);
    CountAll counted;
    list.insert(incoming, counted);
    perMoved.push_back(static_cast<double>(counted.total().resort) /
                       (static_cast<double>(count) / 10));
  }
  EXPECT_LT(perMoved[1], 1.1 * perMoved[0]);
  EXPECT_LT(perMoved[1], 10);
}

// --- Rows of a sweep: the same places as std::lower_bound, for codes that advance, jump and
// return.

constexpr std::uint64_t kEnd = ~std::uint64_t{0};

std::vector<std::uint64_t> randomCodes(std::mt19937_64& random, std::size_t count,
                                       std::uint64_t most) {
  std::vector<std::uint64_t> codes(count);
  for (std::uint64_t& code : codes) code = random() % most;
  std::sort(codes.begin(), codes.end());
  codes.push_back(kEnd);
  return codes;
}

TEST(RowBegins, AreLowerBounds) {
  std::mt19937_64 random(3);
  CountNothing uncounted;
  for (int list = 0; list < 2000; ++list) {
    const std::uint64_t most = 1 + random() % 5000;
    const auto codes = randomCodes(random, random() % 300, most);
    RowBegins::OfLevel places;
    std::uint64_t code = 0;
    for (int look = 0; look < 50; ++look) {
      code = random() % 4 ? code + random() % 40 : random() % (most + 10);
      const int row = static_cast<int>(random() % 20);
      const auto wanted = std::lower_bound(codes.begin(), codes.end(), code) - codes.begin();
      ASSERT_EQ(places.lowerBound(row, codes, code, uncounted), wanted) << list;
    }
  }
}

/// Lemma A.3 with neighbours in the order of the sweep: a constant number of steps for each.
TEST(RowBegins, AdvanceInAFewStepsEach) {
  std::mt19937_64 random(4);
  CountAll counted;
  constexpr std::size_t kCodes = 100000;
  const auto codes = randomCodes(random, kCodes, 3 * kCodes);
  RowBegins::OfLevel places;
  for (std::size_t i = 0; i < kCodes; ++i) places.lowerBound(0, codes, codes[i] + 500, counted);
  EXPECT_LE(counted.total().range, 3 * kCodes);
}

template <int Dim>
void expectAdjacentRows() {
  using Rows = SweptRows<Dim>;
  typename Rows::Cell cell;
  cell.fill(7);
  const std::uint64_t code = Rows::encode(cell);
  ASSERT_TRUE(Rows::isInner(code));
  std::vector<std::uint64_t> found;
  for (int k = 0; k < Rows::kLaterRows; ++k) {
    const CodeRange row = Rows::laterRow(code, k);
    for (std::uint64_t c = row.start; c <= row.stop; ++c) found.push_back(c);
  }
  std::vector<std::uint64_t> wanted;
  constexpr int edge = Rows::kPartsOfX;
  for (int n = 0; n < (Dim == 2 ? 3 : 9); ++n)
    for (int x = -edge; x <= edge; ++x) {
      typename Rows::Cell other = cell;
      other[0] += static_cast<std::uint32_t>(x);
      for (int axis = 1, rest = n; axis < Dim; ++axis, rest /= 3)
        other[axis] += static_cast<std::uint32_t>(rest % 3 - 1);
      if (Rows::encode(other) > code + edge) wanted.push_back(Rows::encode(other));
    }
  std::sort(found.begin(), found.end());
  std::sort(wanted.begin(), wanted.end());
  EXPECT_EQ(found, wanted);
}

TEST(SweptRows, LaterRowsAreTheAdjacentBoxesWithGreaterCodes) {
  expectAdjacentRows<2>();
  expectAdjacentRows<3>();
}

TEST(SweptRows, BoxesAtTheEndsOfACoordinateAreNotInner) {
  using Rows = SweptRows<3>;
  for (int axis = 0; axis < 3; ++axis)
    for (const std::uint32_t end : {std::uint32_t{0}, Rows::Code::kMask}) {
      Rows::Cell cell{5, 5, 5};
      cell[axis] = end;
      EXPECT_FALSE(Rows::isInner(Rows::encode(cell)));
    }
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
