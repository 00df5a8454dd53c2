#pragma once
// The filter boxes of a sorted list in blocks of eight, for long ranges.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/arrays.hpp"
#include "core/lanes.hpp"
#include "search/filter_box.hpp"
#include "search/numbering.hpp"

namespace yadefrag {

/// Where a range of codes begins in the list, up to a block too early.
struct BlockRange {
  std::size_t begin;
  CodeRange codes;
};

/// Ascending within each range. The array is longer than the list, and only grows.
struct NearList {
  std::vector<std::uint32_t> indices;
  std::size_t size = 0;

  [[nodiscard]] std::span<const std::uint32_t> all() const { return {indices.data(), size}; }
};

/// Eight boxes at once, by coordinate: three cache lines. There is no branch that depends on a
/// single box, which would be mispredicted at every second one: rows are swept in .6 of the time.
/// Rejected for ranges on the curve: these have one or two boxes, and take up to 1.1 times as long.
///
///     min  x0 … x7 | y0 … y7 | z0 … z7
///     max  x0 … x7 | y0 … y7 | z0 … z7
class FilterBlocks {
 public:
  static constexpr std::size_t kTogether = 8;

  void resize(std::size_t size) {
    growTo(blocks_, (size + kTogether - 1) / kTogether);
    if (size % kTogether != 0) blocks_.back() = Block::absent();
  }
  void set(std::size_t i, const FilterBox& box) {
    Block& block = blocks_[i / kTogether];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.min[axis][i % kTogether] = box.min[axis];
      block.max[axis][i % kTogether] = box.max[axis];
    }
  }
  [[nodiscard]] FilterBox operator[](std::size_t i) const {
    const Block& block = blocks_[i / kTogether];
    const std::size_t at = i % kTogether;
    return {{block.min[0][at], block.min[1][at], block.min[2][at], 0},
            {block.max[0][at], block.max[1][at], block.max[2][at], 0}};
  }

  /// As in FilterList, but only codes ≥ `start` count: `begin` may be up to a block before it.
  /// `codes` has kTogether greater ones behind the last.
  template <class Found>
  [[gnu::always_inline]] void forEachNear(const FilterBox& box, const std::uint64_t* codes,
                                          std::size_t begin, std::uint64_t start,
                                          std::uint64_t stop, Found found) const {
    for (std::size_t at = begin / kTogether; codes[at * kTogether] <= stop; ++at)
      for (unsigned bits = nearIn(blocks_[at], box); bits != 0; bits &= bits - 1) {
        const std::size_t j = at * kTogether + static_cast<std::size_t>(std::countr_zero(bits));
        if (j >= begin && codes[j] >= start && codes[j] <= stop) found(j);
      }
  }

  /// Sets `near` to the indices that forEachNear finds in all `ranges`, in their order. This is
  /// compiled for each instruction set: a call for all ranges of a box instead of one for each.
  /// AVX2 takes .9 of the time of SSE2, with long rows .6.
  void collectNear(InstructionSet set, const FilterBox& box, const std::uint64_t* codes,
                   std::span<const BlockRange> ranges, NearList& near) const;

  struct alignas(64) Block {
    std::array<std::array<float, kTogether>, 3> min, max;

    /// Boxes that overlap no other.
    static Block absent() {
      Block block;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        block.min[axis].fill(std::numeric_limits<float>::infinity());
        block.max[axis].fill(-std::numeric_limits<float>::infinity());
      }
      return block;
    }
  };

  /// Bit k is 0 only if the original of box k of the block does not overlap that of `box`.
  [[gnu::always_inline]] static unsigned nearIn(const Block& block, const FilterBox& box) {
#if defined(__SSE2__)
    return static_cast<unsigned>(nearInFour(block, box, 0) | nearInFour(block, box, 4) << 4);
#else
    unsigned bits = 0;
    for (std::size_t k = 0; k < kTogether; ++k) {
      bool may = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        may &= block.min[axis][k] <= box.max[axis] && box.min[axis] <= block.max[axis][k];
      bits |= unsigned{may} << k;
    }
    return bits;
#endif
  }

 private:
#if defined(__SSE2__)
  [[gnu::always_inline]] static int nearInFour(const Block& block, const FilterBox& box,
                                               std::size_t first) {
    __m128 near = _mm_castsi128_ps(_mm_set1_epi32(-1));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const __m128 low = _mm_load_ps(&block.min[axis][first]);
      const __m128 high = _mm_load_ps(&block.max[axis][first]);
      near = _mm_and_ps(near, _mm_cmple_ps(low, _mm_set1_ps(box.max[axis])));
      near = _mm_and_ps(near, _mm_cmple_ps(_mm_set1_ps(box.min[axis]), high));
    }
    return _mm_movemask_ps(near);
  }
#endif

  std::vector<Block> blocks_;
};

}  // namespace yadefrag
