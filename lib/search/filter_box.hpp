#pragma once
// Boxes in single precision for a quick first test.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "core/arrays.hpp"
#include "core/box.hpp"

namespace yadefrag {

/// Maps coordinates to floats near zero, where the spacing of floats is smallest.
struct FilterScale {
  std::array<double, 3> origin{0, 0, 0};
  double factor = 1;  // > 0
  [[nodiscard]] float operator()(double x, int axis) const {
    return static_cast<float>((x - origin[axis]) * factor);
  }
};

/// Half a cache line. Every operation of the mapping is monotone, including its rounding: if two
/// boxes overlap, so do their filter boxes. No margin is needed.
struct alignas(32) FilterBox {
  std::array<float, 4> min;
  std::array<float, 4> max;  // the fourth of each is 0

  static FilterBox of(const Box& box, const FilterScale& scale) {
    FilterBox filter{};
    for (int axis = 0; axis < 3; ++axis) {
      filter.min[axis] = scale(box.min[axis], axis);
      filter.max[axis] = scale(box.max[axis], axis);
    }
    return filter;
  }
};

/// False only if the original boxes do not overlap.
inline bool mayOverlap(const FilterBox& a, const FilterBox& b) {
#if defined(__SSE2__)
  const __m128 below = _mm_cmple_ps(_mm_load_ps(a.min.data()), _mm_load_ps(b.max.data()));
  const __m128 above = _mm_cmple_ps(_mm_load_ps(b.min.data()), _mm_load_ps(a.max.data()));
  return _mm_movemask_ps(_mm_and_ps(below, above)) == 15;
#else
  bool may = true;
  for (int axis = 0; axis < 3; ++axis)
    may &= a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis];
  return may;
#endif
}

/// True only if the original boxes overlap: where the images of a monotone mapping are strictly
/// ordered, so are the originals. Nearly all pairs are decided without access to the originals,
/// which are scattered in memory.
inline bool surelyOverlap(const FilterBox& a, const FilterBox& b) {
  bool sure = true;
  for (int axis = 0; axis < 3; ++axis)
    sure &= bool((a.min[axis] < b.max[axis]) & (b.min[axis] < a.max[axis]));
  return sure;
}

/// The filter boxes of a sorted list, one after the other, for short ranges that begin anywhere.
/// filter_blocks.hpp has another layout.
class FilterList {
 public:
  static constexpr std::size_t kTogether = 1;  ///< boxes that are written by one thread

  void resize(std::size_t size) { growTo(boxes_, size); }
  void set(std::size_t i, const FilterBox& box) { boxes_[i] = box; }
  [[nodiscard]] const FilterBox& operator[](std::size_t i) const { return boxes_[i]; }

  /// Calls `found(j)` for each box from index `begin` on, with a code ≤ `stop`, that may overlap
  /// `box`. `codes`: ascending, with greater ones than any `stop` behind the last.
  template <class Found>
  void forEachNear(const FilterBox& box, const std::uint64_t* codes, std::size_t begin,
                   std::uint64_t /*start*/, std::uint64_t stop, Found found) const {
    for (std::size_t j = begin; codes[j] <= stop; ++j)
      if (mayOverlap(box, boxes_[j])) found(j);
  }

 private:
  std::vector<FilterBox> boxes_;
};

}  // namespace yadefrag
