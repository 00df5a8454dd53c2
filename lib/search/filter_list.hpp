#pragma once
// The filter boxes of a sorted list, one after the other. filter_blocks.hpp has another layout.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/arrays.hpp"
#include "search/filter_box.hpp"

namespace yadefrag {

/// One box after the other, for short ranges that begin anywhere.
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
