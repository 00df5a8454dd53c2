#include "search/sorted_list.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <random>

#include "core/comparisons.hpp"

namespace yadefrag {
namespace {

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

TEST(SortedList, MergeIsASortOfBoth) {
  std::mt19937_64 random(6);
  std::vector<CodedSlot> scratch;
  for (int k = 0; k < 2000; ++k) {
    const std::uint64_t most = k % 3 ? 1000000 : 10;
    auto all = randomList(random, random() % 300, most);
    std::vector<CodedSlot> list;
    std::vector<CodedSlot> incoming;
    for (const CodedSlot& entry : all) (random() % 4 ? list : incoming).push_back(entry);
    std::sort(list.begin(), list.end());
    std::sort(incoming.begin(), incoming.end());
    std::sort(all.begin(), all.end());
    CountNothing nothing;
    mergeByCode(list, incoming, scratch, nothing);
    ASSERT_TRUE(same(list, all));
  }
}

TEST(SortedList, ComparisonsOfAMergeDoNotGrowWithTheList) {
  // Lemma A.2: a constant number per entry that moved, here a tenth of them all.
  std::mt19937_64 random(8);
  std::vector<CodedSlot> scratch;
  std::vector<double> perMoved;
  for (const std::size_t count : {1000, 1000000}) {
    auto list = randomList(random, count, 1ULL << 40);
    auto incoming = randomList(random, count / 10, 1ULL << 40);
    sortByCode(list);
    sortByCode(incoming);
    CountAll counted;
    mergeByCode(list, incoming, scratch, counted);
    perMoved.push_back(static_cast<double>(counted.total().resort) /
                       (static_cast<double>(count) / 10));
  }
  EXPECT_LT(perMoved[1], 1.1 * perMoved[0]);
  EXPECT_LT(perMoved[1], 10);
}

}  // namespace
}  // namespace yadefrag
