#include "search/partner_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace yadefrag {
namespace {

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
