#pragma once
// Where the rows of a sweep over boxes in the order of linear codes begin.
//
// A sweep visits the boxes row by row. The boxes that one of them can meet lie in a few adjacent
// rows, and the begin of each of these in the list advances with the sweep: the next begin is
// found from the last one, by single steps, then by strides that double (paper §4.4, lemma A.3).
// All look-ups of a row together take about as many steps as there are codes.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/comparisons.hpp"
#include "core/tolerances/search.hpp"
#include "search/level_grid.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {

class RowBegins {
 public:
  class OfLevel {
   public:
    /// Index of the first code ≥ `code`, for the row'th row of a rectangle. `codes` is ascending;
    /// its last element is greater than any code.
    std::uint32_t lowerBound(int row, std::span<const std::uint64_t> codes, std::uint64_t code,
                             Count& count) {
      std::uint32_t& begin = begins_[static_cast<std::size_t>(row) % begins_.size()];
      count.range(1);
      for (int step = 0; begin > 0 && codes[begin - 1] >= code; ++step) {
        if (step == tolerance::kRowSteps) return begin = bisectCodes(codes, 0, begin, code, count);
        count.range(1);
        --begin;
      }
      for (int step = 0; step < tolerance::kRowSteps; ++step) {
        count.range(1);
        if (codes[begin] >= code) return begin;
        ++begin;
      }
      return begin = gallop(codes, begin, code, count);
    }

   private:
    static std::uint32_t gallop(std::span<const std::uint64_t> codes, std::uint32_t begin,
                                std::uint64_t code, Count& count) {
      const auto last = static_cast<std::uint32_t>(codes.size() - 1);
      std::uint32_t stride = 1;
      while (begin + stride <= last && codes[begin + stride - 1] < code) {
        count.range(1);
        begin += stride;
        stride *= 2;
      }
      return bisectCodes(codes, begin, std::min(last, begin + stride - 1), code, count);
    }

    std::array<std::uint32_t, 64> begins_{};
  };

  OfLevel& of(int level) { return levels_[static_cast<std::size_t>(level)]; }

 private:
  std::array<OfLevel, kLevels> levels_{};
};

}  // namespace yadefrag
