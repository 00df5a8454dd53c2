// What searches take of memory, and that more boxes than can be counted are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "search/box_count.hpp"
#include "search/incremental_search.hpp"

namespace yadefrag {
namespace {

constexpr SearchMethod kMethods[] = {SearchMethod::kLebesgue,  SearchMethod::kLinearCode,
                                     SearchMethod::kSweptRows, SearchMethod::kFastest,
                                     SearchMethod::kHierarchy, SearchMethod::kBruteForce};

TEST(SearchMemory, MoreBoxesThanCanBeCountedAreRefused) {
  // None of them is looked at: there is one.
  const Box one{{0, 0, 0}, {1, 1, 1}};
  for (const std::size_t count : {kMostBoxes + 1, (std::size_t{1} << 32) + 1}) {
    const std::span<const Box> many(&one, count);
    for (const SearchMethod method : kMethods)
      EXPECT_THROW(makeSearch(method)->update(many), RunError);
    IncrementalSearch search(SearchMethod::kLebesgue);
    EXPECT_THROW(search.update(many), RunError);
    search.update({&one, 1});
    EXPECT_THROW(search.change(many, {}), RunError);
  }
}

constexpr double kStated = 106, kStatedForRows = 60;  // bytes

/// Bytes per box of a search that has followed boxes for some updates, beside the boxes themselves
/// and what it takes per pair.
double bytesPerBox(SearchMethod method, std::size_t count, std::size_t& pairsFound) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0, std::cbrt(static_cast<double>(count) * 3));
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + 1;
    }
  IncrementalSearch search(method);
  std::vector<BoxPair> pairs;
  for (int update = 0; update < 3; ++update) {
    for (Box& box : boxes) box.min[0] += .1, box.max[0] += .1;
    search.update(boxes);
    pairs.clear();
    search.findPairs(pairs);
  }
  pairsFound = pairs.size();
  Footprint footprint;
  search.addTo(footprint);
  return (static_cast<double>(footprint.total()) - 8. * static_cast<double>(pairs.capacity())) /
         static_cast<double>(count);
}

TEST(SearchMemory, BytesPerBoxAreStated) {
  // The figures of docs/limits.md, without what is allocated only while codes are sorted.
  std::size_t few = 0, many = 0;
  EXPECT_LE(bytesPerBox(SearchMethod::kLebesgue, 20000, few), kStated);
  EXPECT_LE(bytesPerBox(SearchMethod::kLebesgue, 100000, many), kStated);
  EXPECT_LE(bytesPerBox(SearchMethod::kFastest, 20000, few), kStatedForRows);
  EXPECT_GT(many, 100000U);
}

}  // namespace
}  // namespace yadefrag
