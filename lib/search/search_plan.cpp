#include "search/search_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/tolerances/search.hpp"

namespace yadefrag {
namespace {

struct Sample {
  std::vector<double> sides;
  std::array<double, 3> low;
  std::array<double, 3> high;  // maximum of the lower corners
};

Sample takeSample(std::span<const Box> boxes) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Sample s{{}, {inf, inf, inf}, {-inf, -inf, -inf}};
  const std::size_t stride = boxes.size() / tolerance::kSample + 1;
  for (std::size_t i = 0; i < boxes.size(); i += stride) {
    const Box& box = boxes[i];
    const double side = longestSide(box);
    if (box.isAbsent() || !std::isfinite(side)) continue;
    s.sides.push_back(side);
    for (int axis = 0; axis < 3; ++axis) {
      s.low[axis] = std::min(s.low[axis], box.min[axis]);
      s.high[axis] = std::max(s.high[axis], box.min[axis]);
    }
  }
  return s;
}

/// The longest side within a factor of two above the median of the sorted sides. Bodies of similar
/// size are then on one level, whose edge fits the largest of them.
double typicalSide(const std::vector<double>& sides) {
  const double median = sides[sides.size() / 2];
  return *std::prev(std::upper_bound(sides.begin(), sides.end(), 2 * median));
}

/// The longest side on the level that would have the most boxes, and their part of the sample.
struct Even {
  double side = 0, part = 0;
};

Even mostEven(const std::vector<double>& sides) {
  const auto count = static_cast<double>(sides.size());
  Even best;
  std::size_t begin = 0;
  for (std::size_t end = 0; end < sides.size(); ++end) {
    while (sides[begin] <= .5 * tolerance::kSpareSide * sides[end] && begin < end) ++begin;
    const double part = static_cast<double>(end + 1 - begin) / count;
    if (part >= best.part) best = {sides[end], part};
  }
  return best;
}

/// Part of the sorted sides on a level with this longest side.
double partOn(const std::vector<double>& sides, double extent) {
  const auto count = std::upper_bound(sides.begin(), sides.end(), extent) -
                     std::upper_bound(sides.begin(), sides.end(), .5 * extent);
  return static_cast<double>(count) / static_cast<double>(sides.size());
}

}  // namespace

bool SearchPlan::stillServes(const SearchPlan& now) const {
  return dim == now.dim && axes == now.axes && now.extent < 1.3 * extent &&
         now.extent > extent / 1.3;
}

SearchPlan planSearch(std::span<const Box> boxes, double leastEven, double extentBefore) {
  SearchPlan plan;
  Sample sample = takeSample(boxes);
  if (sample.sides.empty()) return plan;
  plan.low = sample.low;
  std::array<double, 3> spread;
  for (int axis = 0; axis < 3; ++axis) spread[axis] = sample.high[axis] - sample.low[axis];
  std::sort(sample.sides.begin(), sample.sides.end());
  const Even even = mostEven(sample.sides);
  plan.isEven = even.part >= leastEven;
  double side = plan.isEven ? even.side : typicalSide(sample.sides);
  // Points have size 0: any edge far below their spread separates them.
  if (side == 0) side = std::ldexp(*std::max_element(spread.begin(), spread.end()), -20);
  if (!(side > 0) || !std::isnormal(side)) side = 1;
  plan.extent = side * tolerance::kSpareSide;
  if (plan.isEven && partOn(sample.sides, extentBefore) >= tolerance::kStillEven * even.part)
    plan.extent = extentBefore;

  const int flattest =
      static_cast<int>(std::min_element(spread.begin(), spread.end()) - spread.begin());
  if (spread[flattest] <= tolerance::kFlatAxis * side) {
    plan.dim = 2;
    plan.axes = {(flattest + 1) % 3, (flattest + 2) % 3, flattest};
    if (plan.axes[0] > plan.axes[1]) std::swap(plan.axes[0], plan.axes[1]);
  }
  return plan;
}

}  // namespace yadefrag
