// Rows of a sweep: the same places as std::lower_bound, for codes that advance, jump and return.

#include "search/row_begins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/comparisons.hpp"
#include "curve/numbering.hpp"

namespace yadefrag {
namespace {

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

}  // namespace
}  // namespace yadefrag
