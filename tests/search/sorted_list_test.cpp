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

}  // namespace
}  // namespace yadefrag
