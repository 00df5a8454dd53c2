#pragma once
// Boxes without a position code: too large, too distant, or too few of one size (walls, floors,
// outliers). They are tested against all others.

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/comparisons.hpp"
#include "core/ids.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

class WideBoxes {
 public:
  void clear() { slots_.clear(); }
  void add(std::size_t slot) { slots_.push_back(static_cast<std::uint32_t>(slot)); }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> slots() const { return slots_; }

  /// Pairs among the wide boxes; `most` limits the total number of `pairs`.
  void pairsAmong(std::span<const Box> boxes, std::vector<BoxPair>& pairs, Count& count,
                  std::size_t most) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (pairs.size() > most) throw TooManyPairs();
      for (std::size_t j = i + 1; j < slots_.size(); ++j)
        if (test(boxes[slots_[i]], boxes[slots_[j]], count))
          pairs.push_back(orderedPair(BoxId(slots_[i]), BoxId(slots_[j])));
    }
  }

  /// Pairs of another box with the wide ones.
  void pairsWith(std::span<const Box> boxes, const Box& box, std::uint32_t slot,
                 std::vector<BoxPair>& pairs, Count& count) const {
    for (const std::uint32_t wide : slots_)
      if (test(box, boxes[wide], count)) pairs.push_back(orderedPair(BoxId(slot), BoxId(wide)));
  }

  /// The wide boxes that overlap `box`.
  void overlapsWith(std::span<const Box> boxes, const Box& box, std::vector<BoxId>& found,
                    Count& count) const {
    for (const std::uint32_t wide : slots_)
      if (test(box, boxes[wide], count)) found.push_back(BoxId(wide));
  }

 private:
  static bool test(const Box& a, const Box& b, Count& count) {
    count.test(6);
    return overlaps(a, b);
  }

  std::vector<std::uint32_t> slots_;
};

}  // namespace yadefrag
