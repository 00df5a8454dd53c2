// More boxes than can be counted are refused.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace yadefrag
