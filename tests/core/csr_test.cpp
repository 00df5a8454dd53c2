#include "core/csr.hpp"

#include <gtest/gtest.h>

namespace yadefrag {
namespace {

TEST(Csr, RowsKeepTheOrderOfTheItems) {
  const std::vector<int> keys = {2, 0, 2, 3, 0, 2};
  Csr<int> csr;
  fillRows(
      csr, 5, keys.size(), [&](std::size_t i) { return keys[i]; },
      [](std::size_t i) { return static_cast<int>(i); });
  ASSERT_EQ(csr.rows(), 5U);
  const std::vector<std::vector<int>> expected = {{1, 4}, {}, {0, 2, 5}, {3}, {}};
  for (std::size_t r = 0; r < 5; ++r)
    EXPECT_EQ(std::vector<int>(csr.row(r).begin(), csr.row(r).end()), expected[r]) << "row " << r;
}

TEST(Csr, NoItems) {
  Csr<int> csr;
  fillRows(
      csr, 3, 0, [](std::size_t) { return 0; }, [](std::size_t) { return 0; });
  ASSERT_EQ(csr.rows(), 3U);
  for (std::size_t r = 0; r < 3; ++r) EXPECT_TRUE(csr.row(r).empty());
  EXPECT_EQ(Csr<int>().rows(), 0U);
}

TEST(Csr, OffsetsDoNotWrap) {
  Csr<char> csr;
  const auto none = [](std::size_t) -> char { return 0; };
  EXPECT_THROW(fillRows(csr, 1, std::size_t{1} << 32, none, none), RunError);
  EXPECT_EQ(csr.rows(), 0U);
}

}  // namespace
}  // namespace yadefrag
