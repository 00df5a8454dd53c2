#pragma once
// The boxes of one level in the order of their position codes.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/comparisons.hpp"
#include "core/parallel.hpp"
#include "search/code_directory.hpp"
#include "search/filter_blocks.hpp"
#include "search/filter_box.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {

/// `Filters`: FilterList or FilterBlocks.
template <class Filters>
class CodeLevel {
 public:
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] std::uint32_t slot(std::size_t i) const { return list_.slot(i); }
  [[nodiscard]] FilterBox filter(std::size_t i) const { return filters_[i]; }
  [[nodiscard]] const CodeDirectory& directory() const { return directory_; }
  /// Ascending, with SortedList::kEnd behind the last.
  [[nodiscard]] std::span<const std::uint64_t> codes() const { return list_.codes(); }

  /// Calls `visit(slot)` for each box with start ≤ code ≤ stop, from index `begin` on, that
  /// overlaps `box`, whose filter box is `filter`. `boxes`: by slot.
  template <class Visit>
  [[gnu::always_inline]] void forEachOverlap(const Box& box, const FilterBox& filter,
                                             std::span<const Box> boxes, std::uint32_t begin,
                                             std::uint64_t start, std::uint64_t stop,
                                             Visit visit) const {
    filters_.forEachNear(filter, codes().data(), begin, start, stop, [&](std::size_t j) {
      if (overlapsAt(j, box, filter, boxes)) visit(slot(j));
    });
  }

  /// Visits the boxes in all `ranges` that overlap `box`; overwrites `near`. For FilterBlocks.
  template <class Visit>
  void forEachOverlap(InstructionSet set, const Box& box, const FilterBox& filter,
                      std::span<const Box> boxes, std::span<const BlockRange> ranges,
                      NearList& near, Visit visit) const {
    filters_.collectNear(set, filter, codes().data(), ranges, near);
    for (const std::uint32_t j : near.all())
      if (overlapsAt(j, box, filter, boxes)) visit(slot(j));
  }

  /// Removes the entries for which `leaves(slot)` is true, and marks the list as changed.
  template <class Leaves>
  void remove(Leaves leaves) {
    list_.remove(leaves);
    changed_ = true;
  }

  /// Inserts new entries, which ascend in slot.
  void insert(std::vector<CodedSlot>& incoming, Count& count) {
    sortByCode(incoming);
    list_.insert(incoming, count);
    changed_ = true;
  }

  void clear() {
    list_.clear();
    changed_ = true;
  }

  /// Takes the boxes in the order of the list. `withDirectory`: codes are looked up through a
  /// directory.
  void refresh(std::span<const Box> boxes, const FilterScale& scale, bool withDirectory,
               int threads) {
    filters_.resize(size());
    const std::size_t groups = (size() + Filters::kTogether - 1) / Filters::kTogether;
    forEachPart(groups, threads, [&](std::size_t begin, std::size_t end, int) {
      constexpr std::size_t ahead = 16;  // the boxes are in the order of their slots: prefetch
      const std::size_t last = std::min(end * Filters::kTogether, size());
      for (std::size_t i = begin * Filters::kTogether; i < last; ++i) {
        if (i + ahead < last) prefetch(boxes[slot(i + ahead)]);
        filters_.set(i, FilterBox::of(boxes[slot(i)], scale));
      }
    });
    if (changed_ && withDirectory) directory_.build(codes().first(size()));
    changed_ = false;
  }

 private:
  [[gnu::always_inline]] bool overlapsAt(std::size_t j, const Box& box, const FilterBox& filter,
                                         std::span<const Box> boxes) const {
    return surelyOverlap(filter, filters_[j]) || overlaps(box, boxes[slot(j)]);
  }

  SortedList list_;
  Filters filters_;
  CodeDirectory directory_;
  bool changed_ = true;
};

}  // namespace yadefrag
