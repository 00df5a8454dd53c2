#pragma once
// Grids of position-code boxes, one per level, each twice as coarse as the one before. A body box
// lives on the level whose edge fits its longest side, keyed by its lower corner, so that sizes of
// 1 : 10⁴ in one scene cost fourteen levels and not 10¹² boxes a body.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/tolerances/search.hpp"
#include "curve/position_code.hpp"
#include "search/filter_box.hpp"
#include "search/search_plan.hpp"

namespace yadefrag {

/// Level numbers are biased: `kBaseLevel` has the planned edge, there is room below and above it.
inline constexpr int kBaseLevel = 20;
inline constexpr int kLevels = 60;

/// `std::floor` is a call on plain amd64 (no SSE4.1); this is exact for |x| < 2⁶².
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
  explicit LevelGrid(const SearchPlan& plan) : plan_(plan) {
    for (int level = 0; level < kLevels; ++level) {
      inverseEdge_[level] = 1 / std::ldexp(plan.edge, level - kBaseLevel);
      for (int d = 0; d < Dim; ++d) {
        const double origin = plan.low[plan.axes[d]] * inverseEdge_[level];
        // Beyond 2^30 boxes from zero the origin keeps its place: coordinates there are not coded.
        origin_[level][d] = std::abs(origin) < kFarthest ? floorToInt(origin) : 0;
      }
    }
    inverseSmallest_ = inverseEdge_[0] * tolerance::kEdgeOverExtent;
  }

  [[nodiscard]] int axis(int d) const { return plan_.axes[d]; }

  /// For filters of all levels: origin and edge of the base level.
  [[nodiscard]] FilterScale filterScale() const { return {plan_.low, 1 / plan_.edge}; }

  /// The finest level whose edge is at least kEdgeOverExtent times `side`; kLevels if there is
  /// none.
  [[nodiscard]] int levelOf(double side) const {
    const double ratio = side * inverseSmallest_;
    if (!(ratio > 1)) return 0;
    const auto bits = std::bit_cast<std::uint64_t>(ratio);
    const int exponent = static_cast<int>(bits >> 52) - 1023;
    const int level = exponent + ((bits & 0x000fffffffffffffULL) != 0);
    return level < kLevels ? level : kLevels;
  }

  /// x in box edges of the level; box number k holds k + origin ≤ scaled < k + 1 + origin.
  [[nodiscard]] double scaled(double x, int level) const { return x * inverseEdge_[level]; }
  [[nodiscard]] std::int64_t origin(int level, int d) const { return origin_[level][d]; }

  /// False for coordinates too far out to be numbered at this level.
  static bool isNumbered(double scaled) { return std::abs(scaled) < kFarthest; }

  /// Box number of x along coded axis d, not yet taken modulo 2^kBits. Monotone in x, because the
  /// one rounding is that of a product with a constant.
  [[nodiscard]] std::int32_t number(double x, int level, int d) const {
    return static_cast<std::int32_t>(floorToInt(scaled(x, level)) - origin_[level][d]);
  }

 private:
  static constexpr double kFarthest = 536870912.0;  // 2^29: differences fit 32 bits

  SearchPlan plan_;
  std::array<double, kLevels> inverseEdge_{};
  std::array<std::array<std::int64_t, Dim>, kLevels> origin_{};
  double inverseSmallest_ = 1;
};

}  // namespace yadefrag
