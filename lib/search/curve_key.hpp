#pragma once
// The place of a box on the Lebesgue curve, to order by it what was found in another order.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/box.hpp"
#include "search/position_code.hpp"
#include "search/search_plan.hpp"

namespace yadefrag {

class CurveKey {
 public:
  /// The position-code boxes are as long as the longest of most boxes.
  explicit CurveKey(std::span<const Box> boxes)
      : plan_(planSearch(boxes)), perLength_(1 / plan_.extent) {}

  /// Code of the box's lower corner. Boxes outside the sample's range have the code of the nearest
  /// place in it.
  [[nodiscard]] std::uint64_t operator()(const Box& box) const {
    return plan_.dim == 2 ? code<2>(box) : code<3>(box);
  }

 private:
  template <int Dim>
  [[nodiscard]] std::uint64_t code(const Box& box) const {
    using Code = PositionCode<Dim>;
    constexpr double last = Code::kMask;
    typename Code::Cell cell;
    for (std::size_t d = 0; d < Dim; ++d) {
      const auto axis = static_cast<std::size_t>(plan_.axes[d]);
      const double at = (box.min[axis] - plan_.low[axis]) * perLength_;
      cell[d] = static_cast<std::uint32_t>(std::clamp(at, 0., last));
    }
    return Code::encode(cell);
  }

  SearchPlan plan_;
  double perLength_;  // 1/m
};

}  // namespace yadefrag
