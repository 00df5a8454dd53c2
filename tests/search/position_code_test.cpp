// The laws at the head of search/position_code.hpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "search/code_ranges.hpp"
#include "search/numbering.hpp"
#include "search/position_code.hpp"

namespace yadefrag {
namespace {

template <class Dimension>
class PositionCodeLaws : public testing::Test {
 protected:
  static constexpr int kDim = Dimension::value;
  using Code = PositionCode<kDim>;
  using Cell = typename Code::Cell;
  std::mt19937_64 random_{7};

  Cell randomCell() {
    Cell cell;
    // All magnitudes, so that high boundaries are met as often as low ones.
    for (auto& c : cell)
      c = static_cast<std::uint32_t>(random_() >> (random_() % 64)) & Code::kMask;
    return cell;
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PositionCodeLaws, Dimensions);

/// Which numbers the quarters as figure 5 does.
TYPED_TEST(PositionCodeLaws, EncodesBitByBit) {
  using Code = typename TestFixture::Code;
  constexpr int dim = TestFixture::kDim;
  for (int axis = 0; axis < dim; ++axis)
    for (int bit = 0; bit < Code::kBits; ++bit) {
      typename Code::Cell cell{};
      cell[axis] = std::uint32_t{1} << bit;
      EXPECT_EQ(Code::encode(cell), std::uint64_t{1} << (dim * bit + dim - 1 - axis));
    }
}

/// Codes are monotone in every coordinate, and a step is the code of the neighbour.
TYPED_TEST(PositionCodeLaws, RoundTripOrderAndSteps) {
  using Code = typename TestFixture::Code;
  for (int k = 0; k < 100000; ++k) {
    auto cell = this->randomCell();
    if (k < 4) cell.fill(k % 2 ? Code::kMask : 0);  // the wrap, both ways
    const std::uint64_t code = Code::encode(cell);
    ASSERT_EQ(Code::decode(code), cell);
    auto low = this->randomCell(), high = cell;
    for (int axis = 0; axis < TestFixture::kDim; ++axis) {
      auto down = cell, up = cell;
      down[axis] = (down[axis] - 1) & Code::kMask;
      up[axis] = (up[axis] + 1) & Code::kMask;
      ASSERT_EQ(Code::stepDown(code, axis, cell[axis]), Code::encode(down));
      ASSERT_EQ(Code::stepUp(code, axis, cell[axis]), Code::encode(up));
      if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
    }
    ASSERT_LE(Code::encode(low), Code::encode(high));
  }
}

TYPED_TEST(PositionCodeLaws, StartAndStopCodesBoundTheBlock) {
  using Code = typename TestFixture::Code;
  for (int k = 0; k < 20000; ++k) {
    const auto cell = this->randomCell();
    const int i = static_cast<int>(this->random_() % 12);
    auto low = cell;
    auto high = cell;
    for (std::size_t d = 0; d < cell.size(); ++d) {
      low[d] = (cell[d] >> i) << i;
      high[d] = low[d] + ((std::uint32_t{1} << i) - 1);
    }
    const std::uint64_t code = Code::encode(cell);
    ASSERT_EQ(Code::startCode(code, i), Code::encode(low));
    ASSERT_EQ(Code::stopCode(code, i), Code::encode(high));
    // As many codes as boxes: the block's are all of them.
    ASSERT_EQ(Code::stopCode(code, i) - Code::startCode(code, i) + 1,
              std::uint64_t{1} << (TestFixture::kDim * i));
  }
}

// --- Every box of a rectangle lies in a range, at most 2^Dim ranges, clipped and no longer than
// need be.

template <class Numbering>
class RangeLaws : public testing::Test {};

using Numberings = testing::Types<LebesgueNumbering<2>, LebesgueNumbering<3>, LinearNumbering<2>,
                                  LinearNumbering<3>>;
TYPED_TEST_SUITE(RangeLaws, Numberings);

template <class Cell>
struct CellRectangle {
  Cell low, high;
  std::array<std::uint32_t, 3> length{1, 1, 1};
};

template <class Numbering>
CellRectangle<typename Numbering::Cell> randomRectangle(std::mt19937_64& random) {
  CellRectangle<typename Numbering::Cell> r;
  constexpr std::uint32_t mask = Numbering::Code::kMask;
  for (std::size_t d = 0; d < r.low.size(); ++d) {
    r.length[d] = 1 + random() % 6;
    // Near high boundaries, and across the wrap, as often as anywhere.
    const std::uint32_t near = static_cast<std::uint32_t>(random() % 8) << (random() % 20);
    r.low[d] = (near - static_cast<std::uint32_t>(random() % 4)) & mask;
    r.high[d] = (r.low[d] + r.length[d] - 1) & mask;
  }
  return r;
}

TYPED_TEST(RangeLaws, HoldEveryBoxOfTheRectangleOnce) {
  std::mt19937_64 random(11);
  for (int k = 0; k < 20000; ++k) {
    const auto r = randomRectangle<TypeParam>(random);
    std::vector<CodeRange> ranges;
    TypeParam::forEachRange(TypeParam::encode(r.low), TypeParam::encode(r.high),
                            [&](const CodeRange& range) {
                              ASSERT_LE(range.start, range.stop);
                              ranges.push_back(range);
                            });
    std::sort(ranges.begin(), ranges.end(), [](auto& a, auto& b) { return a.start < b.start; });
    for (std::size_t i = 1; i < ranges.size(); ++i)
      ASSERT_LT(ranges[i - 1].stop, ranges[i].start) << "two ranges share a code";
    auto cell = r.low;
    for (std::uint32_t z = 0; z < r.length[2]; ++z)
      for (std::uint32_t y = 0; y < r.length[1]; ++y)
        for (std::uint32_t x = 0; x < r.length[0]; ++x) {
          const std::array<std::uint32_t, 3> step = {x, y, z};
          for (std::size_t d = 0; d < cell.size(); ++d)
            cell[d] = (r.low[d] + step[d]) & TypeParam::Code::kMask;
          const std::uint64_t code = TypeParam::encode(cell);
          const bool inside = std::any_of(
              ranges.begin(), ranges.end(),
              [&](const CodeRange& range) { return range.start <= code && code <= range.stop; });
          ASSERT_TRUE(inside);
        }
  }
}

TYPED_TEST(RangeLaws, StepsToTheNextBox) {
  std::mt19937_64 random(14);
  using Code = typename TypeParam::Code;
  for (int k = 0; k < 20000; ++k) {
    auto cell = randomRectangle<TypeParam>(random).low;
    if (k < 2) cell.fill(k == 0 ? 0 : Code::kMask);
    for (int axis = 0; axis < static_cast<int>(cell.size()); ++axis) {
      auto next = cell;
      next[axis] = (cell[axis] + 1) & Code::kMask;
      ASSERT_EQ(TypeParam::up(TypeParam::encode(cell), axis), TypeParam::encode(next));
      ASSERT_EQ(TypeParam::down(TypeParam::encode(next), axis), TypeParam::encode(cell));
    }
  }
}

TEST(CodeRanges, LargeRectanglesAreCutUntilLittleElseIsInTheRanges) {
  std::mt19937_64 random(15);
  using Code = PositionCode<3>;
  for (int k = 0; k < 300; ++k) {
    Code::Cell low;
    Code::Cell high;
    std::uint64_t boxes = 1;
    for (int d = 0; d < 3; ++d) {
      const auto length = 1 + static_cast<std::uint32_t>(random() >> (58 + random() % 6));
      low[d] = static_cast<std::uint32_t>(random() % 100000);
      high[d] = low[d] + length - 1;
      boxes *= length;
    }
    std::vector<CodeRange> ranges;
    std::uint64_t codes = 0;
    LebesgueNumbering<3>::forEachRangeOfLarge(Code::encode(low), Code::encode(high),
                                              [&](auto range) {
                                                if (!ranges.empty()) {
                                                  ASSERT_GT(range.start, ranges.back().stop);
                                                }
                                                ranges.push_back(range);
                                                codes += range.stop - range.start + 1;
                                              });
    ASSERT_LE(codes, tolerance::kCodesPerBox * boxes);
    Code::Cell cell;
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
          const std::uint64_t code = Code::encode(cell);
          const auto after = std::partition_point(ranges.begin(), ranges.end(),
                                                  [&](auto& range) { return range.start <= code; });
          ASSERT_TRUE(after != ranges.begin() && code <= std::prev(after)->stop);
        }
  }
}

TEST(CodeRanges, AtMostFourInTwoDimensionsAndEightInThree) {
  std::mt19937_64 random(12);
  int most2 = 0;
  int most3 = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto r2 = randomRectangle<LebesgueNumbering<2>>(random);
    const auto r3 = randomRectangle<LebesgueNumbering<3>>(random);
    most2 = std::max(most2, rangesOfRectangle<2>(PositionCode<2>::encode(r2.low),
                                                 PositionCode<2>::encode(r2.high))
                                .count);
    most3 = std::max(most3, rangesOfRectangle<3>(PositionCode<3>::encode(r3.low),
                                                 PositionCode<3>::encode(r3.high))
                                .count);
  }
  EXPECT_EQ(most2, 4);
  EXPECT_EQ(most3, 8);
}

TEST(CodeRanges, ClippingHalvesWhatTheBlocksWouldHold) {
  // DESIGN: clipped to corner codes, ranges hold about half of what whole blocks hold.
  std::mt19937_64 random(13);
  using Code = PositionCode<2>;
  double clipped = 0;
  double blocks = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<std::uint32_t, 2> low;
    std::array<std::uint32_t, 2> high;
    for (int d = 0; d < 2; ++d) {
      low[d] = static_cast<std::uint32_t>(random() % 4096);
      high[d] = low[d] + 1 + static_cast<std::uint32_t>(random() % 4);
    }
    const CodeRanges<2> ranges = rangesOfRectangle<2>(Code::encode(low), Code::encode(high));
    for (int r = 0; r < ranges.count; ++r) {
      const auto [start, stop] = ranges.range[r];
      clipped += static_cast<double>(stop - start + 1);
      const int i = (static_cast<int>(std::bit_width(start ^ stop)) + 1) / 2;
      blocks += static_cast<double>(Code::stopCode(stop, i) - Code::startCode(start, i) + 1);
    }
  }
  EXPECT_LT(clipped / blocks, .7);
}

}  // namespace
}  // namespace yadefrag
