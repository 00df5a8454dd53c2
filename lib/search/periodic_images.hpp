#pragma once
// Copies of boxes that stick out of a periodic cell, so that any search, which knows no cell, finds
// the pairs across its faces.
//
// Every box is moved into the cell by whole cells, lower corner first; where it sticks out of the
// upper face of an axis it gets a copy one cell lower. On each axis the pair (a, b) is found with
// neither, with a or with b shifted, one for each way in which they can overlap; pairs that are
// both shifted on one axis are found without that shift too and dropped.

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

  /// Box i < slots is box i moved into the cell; the copies follow.
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }

  /// Turns pairs of boxes() into pairs of slots. A pair that touches in two ways comes twice.
  void toSlots(std::vector<BoxPair>& pairs) const;

  /// Largest difference in cells between two boxes' lower corners, per axis, plus one.
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
