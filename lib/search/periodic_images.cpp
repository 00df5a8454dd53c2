#include "search/periodic_images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace yadefrag {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moves the box's lower corner into [0, size); returns the shift in cells.
double wrapAxis(Box& box, int axis, double size, double margin) {
  double& low = box.min[axis];
  double& high = box.max[axis];
  if (!(high - low < size * (1 - 2 * margin))) {
    low = -kInfinity;
    high = kInfinity;
    return 0;
  }
  low -= margin * size;
  high += margin * size;
  const double cells = std::floor(low / size);
  // Rounding may put `low` slightly outside the cell: the margin covers that.
  low -= cells * size;
  high -= cells * size;
  return cells;
}

}  // namespace

void PeriodicImages::build(std::span<const Box> boxes, const std::array<double, 3>& size,
                           double margin) {
  slots_ = boxes.size();
  boxes_.assign(boxes.begin(), boxes.end());
  origins_.clear();
  std::array<double, 3> least = {kInfinity, kInfinity, kInfinity};
  std::array<double, 3> most = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < slots_; ++i) {
    if (boxes_[i].isAbsent()) continue;
    unsigned sticksOut = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cells = wrapAxis(boxes_[i], axis, size[axis], margin);
      least[axis] = std::min(least[axis], cells);
      most[axis] = std::max(most[axis], cells);
      const double high = boxes_[i].max[axis];
      if (high >= size[axis] && high < kInfinity) sticksOut |= 1U << axis;
    }
    for (unsigned shifted = 1; shifted < 8; ++shifted) {
      if ((shifted & sticksOut) != shifted) continue;
      Box copy = boxes_[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (!(shifted >> axis & 1)) continue;
        copy.min[axis] -= size[axis];
        copy.max[axis] -= size[axis];
      }
      boxes_.push_back(copy);
      origins_.push_back({static_cast<std::uint32_t>(i), shifted});
    }
  }
  for (int axis = 0; axis < 3; ++axis)
    span_[axis] = most[axis] >= least[axis] ? most[axis] - least[axis] + 1 : 0;
}

void PeriodicImages::toSlots(std::vector<BoxPair>& pairs) const {
  const auto originOf = [&](BoxId id) {
    return id.value < slots_ ? Origin{id.value, 0} : origins_[id.value - slots_];
  };
  auto kept = pairs.begin();
  for (const BoxPair& pair : pairs) {
    const Origin a = originOf(pair.first);
    const Origin b = originOf(pair.second);
    if (a.slot == b.slot || (a.shifted & b.shifted) != 0) continue;
    *kept++ = orderedPair(BoxId(a.slot), BoxId(b.slot));
  }
  pairs.erase(kept, pairs.end());
}

}  // namespace yadefrag
