#include "search/filter_blocks.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace yadefrag {
namespace {

using Block = FilterBlocks::Block;

/// Appends the boxes of a block whose `bits` are set and whose codes are in the range to the first
/// `size` of `near`; returns their new number. Without a branch: an index that does not count is
/// overwritten by the next one.
[[gnu::always_inline]] inline std::size_t append(unsigned bits, std::size_t block,
                                                 const std::uint64_t* codes,
                                                 const BlockRange& range, std::size_t size,
                                                 std::vector<std::uint32_t>& near) {
  constexpr std::size_t width = FilterBlocks::kTogether;
  if (near.size() < size + width) near.resize(2 * (size + width));
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t j = block * width + static_cast<std::size_t>(std::countr_zero(bits));
    near[size] = static_cast<std::uint32_t>(j);
    const bool counts =
        (j >= range.begin) & (codes[j] >= range.codes.start) & (codes[j] <= range.codes.stop);
    size += counts ? 1 : 0;
  }
  return size;
}

std::size_t collectBaseline(const Block* blocks, const FilterBox& box, const std::uint64_t* codes,
                            std::span<const BlockRange> ranges, std::vector<std::uint32_t>& near) {
  constexpr std::size_t width = FilterBlocks::kTogether;
  std::size_t size = 0;
  for (const BlockRange& range : ranges)
    for (std::size_t at = range.begin / width; codes[at * width] <= range.codes.stop; ++at)
      if (const unsigned bits = FilterBlocks::nearIn(blocks[at], box); bits != 0)
        size = append(bits, at, codes, range, size, near);
  return size;
}

#ifdef __x86_64__
/// One register for a coordinate of a block. The box is in registers for all ranges.
[[gnu::target("avx2")]] std::size_t collectAvx2(const Block* blocks, const FilterBox& box,
                                                const std::uint64_t* codes,
                                                std::span<const BlockRange> ranges,
                                                std::vector<std::uint32_t>& near) {
  constexpr std::size_t width = FilterBlocks::kTogether;
  std::size_t size = 0;
  const __m256 min[3] = {_mm256_set1_ps(box.min[0]), _mm256_set1_ps(box.min[1]),
                         _mm256_set1_ps(box.min[2])};
  const __m256 max[3] = {_mm256_set1_ps(box.max[0]), _mm256_set1_ps(box.max[1]),
                         _mm256_set1_ps(box.max[2])};
  for (const BlockRange& range : ranges)
    for (std::size_t at = range.begin / width; codes[at * width] <= range.codes.stop; ++at) {
      __m256 all = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
      for (int axis = 0; axis < 3; ++axis) {
        const __m256 low = _mm256_load_ps(blocks[at].min[axis].data());
        const __m256 high = _mm256_load_ps(blocks[at].max[axis].data());
        all = _mm256_and_ps(all, _mm256_cmp_ps(low, max[axis], _CMP_LE_OQ));
        all = _mm256_and_ps(all, _mm256_cmp_ps(min[axis], high, _CMP_LE_OQ));
      }
      if (const auto bits = static_cast<unsigned>(_mm256_movemask_ps(all)); bits != 0)
        size = append(bits, at, codes, range, size, near);
    }
  return size;
}
#endif

}  // namespace

void FilterBlocks::collectNear(InstructionSet set, const FilterBox& box, const std::uint64_t* codes,
                               std::span<const BlockRange> ranges, NearList& near) const {
#ifdef __x86_64__
  if (set == InstructionSet::kAvx2) {
    near.size = collectAvx2(blocks_.data(), box, codes, ranges, near.indices);
    return;
  }
#endif
  static_cast<void>(set);
  near.size = collectBaseline(blocks_.data(), box, codes, ranges, near.indices);
}

}  // namespace yadefrag
