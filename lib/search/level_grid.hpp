#pragma once
// Grids of position-code boxes, one per level; each is twice as coarse as the one before. A body
// box is stored on the level whose edge fits its longest side, keyed by its lower corner. Sizes of
// 1 : 10⁴ in one scene therefore need fourteen levels, not 10¹² boxes per body.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/tolerances/search.hpp"
#include "search/filter_box.hpp"
#include "search/position_code.hpp"
#include "search/search_plan.hpp"

namespace yadefrag {

/// Level numbers have an offset: `kBaseLevel` has the planned edge; finer and coarser levels exist
/// below and above it.
inline constexpr int kBaseLevel = 20;
inline constexpr int kLevels = 60;

/// A replacement of `std::floor`, which is a function call on plain amd64 (without SSE4.1); exact
/// for |x| < 2⁶².
inline std::int64_t floorToInt(double x) {
  const auto t = static_cast<std::int64_t>(x);
  return t - (static_cast<double>(t) > x);
}

template <int Dim>
class LevelGrid {
 public:
  using Code = PositionCode<Dim>;
  using Cell = typename Code::Cell;

  LevelGrid() = default;
  /// `edgeOverExtent`: of the boxes of a level, over its longest body box; `partsOfX`: number of
  /// boxes per edge along the first axis, a power of two; `first`: the number of the boxes at the
  /// origin.
  LevelGrid(const SearchPlan& plan, double edgeOverExtent, int partsOfX, std::int64_t first)
      : plan_(plan), edge_(plan.extent * edgeOverExtent) {
    for (int level = 0; level < kLevels; ++level) {
      inverseEdge_[level].fill(1 / std::ldexp(edge_, level - kBaseLevel));
      inverseEdge_[level][0] *= partsOfX;
      for (int d = 0; d < Dim; ++d) {
        const double origin = plan.low[plan.axes[d]] * inverseEdge_[level][d];
        // Beyond 2^30 boxes from zero the origin is not changed: coordinates there get no code.
        origin_[level][d] = (std::abs(origin) < kFarthest ? floorToInt(origin) : 0) - first;
      }
    }
    inverseSmallest_ = inverseEdge_[0][1] * edgeOverExtent;
  }

  [[nodiscard]] int axis(int d) const { return plan_.axes[d]; }

  /// Origin and edge of the base level, for the filter boxes of all levels.
  [[nodiscard]] FilterScale filterScale() const { return {plan_.low, 1 / edge_}; }

  /// The finest level whose edge is at least edgeOverExtent times `side`; kLevels if there is no
  /// such level.
  [[nodiscard]] int levelOf(double side) const {
    const double ratio = side * inverseSmallest_;
    if (!(ratio > 1)) return 0;
    const auto bits = std::bit_cast<std::uint64_t>(ratio);
    const int exponent = static_cast<int>(bits >> 52) - 1023;
    const int level = exponent + ((bits & 0x000fffffffffffffULL) != 0);
    return level < kLevels ? level : kLevels;
  }

  /// x along the coded axis d, in boxes of the level; box number k holds k + origin ≤ scaled < k +
  /// 1
  /// + origin.
  [[nodiscard]] double scaled(double x, int level, int d) const {
    return x * inverseEdge_[level][d];
  }
  [[nodiscard]] std::int64_t origin(int level, int d) const { return origin_[level][d]; }

  /// False for coordinates too distant for a number on this level.
  static bool isNumbered(double scaled) { return std::abs(scaled) < kFarthest; }

  /// Box number of x along the coded axis d, before the reduction modulo 2^kBits. It is monotone in
  /// x, because its only rounding is that of a product with a constant.
  [[nodiscard]] std::int32_t number(double x, int level, int d) const {
    return static_cast<std::int32_t>(floorToInt(scaled(x, level, d)) - origin_[level][d]);
  }

 private:
  static constexpr double kFarthest = 536870912.0;  // 2^29: differences fit 32 bits

  SearchPlan plan_;
  double edge_ = 1;  // m, of level kBaseLevel
  std::array<std::array<double, Dim>, kLevels> inverseEdge_{};
  std::array<std::array<std::int64_t, Dim>, kLevels> origin_{};
  double inverseSmallest_ = 1;
};

}  // namespace yadefrag
