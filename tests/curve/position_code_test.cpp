// The laws at the head of curve/position_code.hpp.
#include "curve/position_code.hpp"

#include <gtest/gtest.h>

#include <random>

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

TYPED_TEST(PositionCodeLaws, RoundTrip) {
  using Code = typename TestFixture::Code;
  for (int k = 0; k < 100000; ++k) {
    const auto cell = this->randomCell();
    ASSERT_EQ(Code::decode(Code::encode(cell)), cell);
  }
}

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

TEST(PositionCode, QuartersAreNumberedAsInFigure5) {
  using Code = PositionCode<2>;
  EXPECT_EQ(Code::encode({0, 0}), 0b00U);  // bottom left
  EXPECT_EQ(Code::encode({0, 1}), 0b01U);  // top left
  EXPECT_EQ(Code::encode({1, 0}), 0b10U);  // bottom right
  EXPECT_EQ(Code::encode({1, 1}), 0b11U);  // top right
}

TYPED_TEST(PositionCodeLaws, MonotoneInEveryCoordinate) {
  using Code = typename TestFixture::Code;
  for (int k = 0; k < 100000; ++k) {
    auto low = this->randomCell();
    auto high = this->randomCell();
    for (std::size_t d = 0; d < low.size(); ++d)
      if (low[d] > high[d]) std::swap(low[d], high[d]);
    ASSERT_LE(Code::encode(low), Code::encode(high));
  }
}

TYPED_TEST(PositionCodeLaws, StepIsEncodeOfTheNeighbour) {
  using Code = typename TestFixture::Code;
  for (int k = 0; k < 100000; ++k) {
    auto cell = this->randomCell();
    if (k < 4) cell.fill(k % 2 ? Code::kMask : 0);  // the wrap, both ways
    const std::uint64_t code = Code::encode(cell);
    for (int axis = 0; axis < TestFixture::kDim; ++axis) {
      auto down = cell;
      auto up = cell;
      down[axis] = (down[axis] - 1) & Code::kMask;
      up[axis] = (up[axis] + 1) & Code::kMask;
      ASSERT_EQ(Code::stepDown(code, axis, cell[axis]), Code::encode(down));
      ASSERT_EQ(Code::stepUp(code, axis, cell[axis]), Code::encode(up));
    }
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

}  // namespace
}  // namespace yadefrag
