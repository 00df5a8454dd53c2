#pragma once
// Adds copies of the boxes that protrude from a periodic cell. A search without periodicity then
// finds the pairs across the cell's faces, too.
//
// Every box is moved into the cell by whole cells, lower corner first. Where it protrudes from the
// upper face of an axis it gets a copy one cell lower. On each axis the pair (a, b) is found with
// no shift, with a shifted, or with b shifted: one for each way in which they can overlap. A pair
// with both shifted on one axis is also found without that shift; the duplicate is removed.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/ids.hpp"

namespace yadefrag {

class PeriodicImages {
 public:
  /// Takes boxes (one per slot) and the cell's edges (m); `margin` (in cell sizes) is added around
  /// every box. Boxes as long as the cell fill their axis.
  void build(std::span<const Box> boxes, const std::array<double, 3>& size, double margin);

  /// Box i < slots is box i moved into the cell; the copies are after these.
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }

  /// Converts pairs of boxes() into pairs of slots. A pair that overlaps in two ways occurs twice.
  void toSlots(std::vector<BoxPair>& pairs) const;

  /// Per axis: the largest difference in cells between two boxes' lower corners, plus one.
  [[nodiscard]] const std::array<double, 3>& span() const { return span_; }

 private:
  struct Origin {
    std::uint32_t slot;
    std::uint32_t shifted;  // bit per axis
  };
  std::vector<Box> boxes_;
  std::vector<Origin> origins_;  // of the copies
  std::size_t slots_ = 0;
  std::array<double, 3> span_{};
};

}  // namespace yadefrag
