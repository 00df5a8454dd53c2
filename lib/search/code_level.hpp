#pragma once
// The boxes of one level in the order of their position codes.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/footprint.hpp"
#include "search/code_directory.hpp"
#include "search/filter_box.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {

/// A box together with its slot: an exact test reads one cache line.
struct alignas(64) CodedBox {
  Box box;
  std::uint32_t slot;
};

class CodeLevel {
 public:
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] const CodedBox& operator[](std::size_t i) const { return boxes_[i]; }
  [[nodiscard]] const FilterBox& filter(std::size_t i) const { return filters_[i]; }
  [[nodiscard]] std::uint64_t code(std::size_t i) const { return codes_[i]; }
  [[nodiscard]] const CodeDirectory& directory() const { return directory_; }
  /// Ascending, with kEnd behind the last.
  [[nodiscard]] std::span<const std::uint64_t> codes() const { return codes_; }
  static constexpr std::uint64_t kEnd = ~std::uint64_t{0};

  /// Removes the entries for which `leaves(slot)` is true, and marks the list as changed.
  template <class Leaves>
  void remove(Leaves leaves) {
    std::erase_if(list_, [&](const CodedSlot& c) { return leaves(c.slot); });
    changed_ = true;
  }

  /// Inserts new entries, which ascend in slot.
  template <class Count>
  void insert(std::vector<CodedSlot>& incoming, std::vector<CodedSlot>& scratch, Count& count) {
    sortByCode(incoming);
    mergeByCode(list_, incoming, scratch, count);
    changed_ = true;
  }

  void clear() {
    list_.clear();
    changed_ = true;
  }

  /// Copies the boxes in curve order. `withDirectory`: codes are looked up through a directory.
  void refresh(std::span<const Box> boxes, const FilterScale& scale, bool withDirectory,
               int threads);

  void addTo(Footprint& footprint) const {
    footprint.add(Use::kSearch, list_, codes_, boxes_, filters_);
    directory_.addTo(footprint);
  }

 private:
  std::vector<CodedSlot> list_;
  std::vector<std::uint64_t> codes_;
  std::vector<CodedBox> boxes_;
  std::vector<FilterBox> filters_;
  CodeDirectory directory_;
  bool changed_ = true;
};

}  // namespace yadefrag
