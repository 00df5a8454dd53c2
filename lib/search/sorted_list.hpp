#pragma once
// The sorted list of codes that a search keeps from one update to the next.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/arrays.hpp"
#include "core/comparisons.hpp"

namespace yadefrag {

struct CodedSlot {
  std::uint64_t code;
  std::uint32_t slot;

  /// Equal codes are ordered by slot: the order then does not depend on the order of insertion.
  friend bool operator<(const CodedSlot& a, const CodedSlot& b) {
    return a.code != b.code ? a.code < b.code : a.slot < b.slot;
  }
};

/// Index of the first code ≥ `code` of the ascending `codes`; it is known to be in [begin, end].
/// Without a branch that depends on a code: half of them would be mispredicted.
inline std::uint32_t bisectCodes(std::span<const std::uint64_t> codes, std::uint32_t begin,
                                 std::uint32_t end, std::uint64_t code, Count& count) {
  for (std::uint32_t size = end - begin; size > 0;) {
    const std::uint32_t half = (size + 1) / 2;
    count.range(1);
    begin += half * static_cast<std::uint32_t>(codes[begin + half - 1] < code);
    size -= half;
  }
  return begin;
}

/// Sorts a list that ascends in slot (radix sort: stable, without comparisons).
void sortByCode(std::vector<CodedSlot>& list);

/// Codes and slots in ascending order. Two arrays: 12 bytes an entry, and codes without gaps.
class SortedList {
 public:
  /// Greater than any code. There are kSpare of them behind the last code: groups of this many
  /// codes may be read from any entry on.
  static constexpr std::uint64_t kEnd = ~std::uint64_t{0};
  static constexpr std::size_t kSpare = 8;

  SortedList() { setEnd(); }

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] std::uint32_t slot(std::size_t i) const { return slots_[i]; }
  /// Ascending, with one kEnd behind the last.
  [[nodiscard]] std::span<const std::uint64_t> codes() const { return {codes_.data(), size() + 1}; }

  void clear() {
    slots_.clear();
    setEnd();
  }

  /// Removes the entries for which `leaves(slot)` is true.
  template <class Leaves>
  void remove(Leaves leaves) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (leaves(slots_[i])) continue;
      codes_[kept] = codes_[i];
      slots_[kept++] = slots_[i];
    }
    slots_.resize(kept);
    setEnd();
  }

  /// Inserts entries that are sorted, too, from the last to the first. The place of each is found
  /// from the previous one by exponential, then binary search (paper §4.4, lemma A.2). The number
  /// of comparisons grows with the gaps between the new entries, not with the length of the list;
  /// every entry is shifted once, within the same arrays.
  void insert(std::span<const CodedSlot> incoming, Count& count) {
    std::size_t end = size();  // of the entries that have not been shifted
    std::size_t to = end + incoming.size();
    growTo(slots_, to);
    setEnd();
    for (auto in = incoming.rbegin(); in != incoming.rend(); ++in) {
      const std::size_t place = placeOf(*in, end, count);
      std::copy_backward(codes_.data() + place, codes_.data() + end, codes_.data() + to);
      std::copy_backward(slots_.data() + place, slots_.data() + end, slots_.data() + to);
      to -= end - place + 1;
      end = place;
      codes_[to] = in->code;
      slots_[to] = in->slot;
    }
  }

 private:
  void setEnd() {
    growTo(codes_, size() + kSpare);
    std::fill(codes_.end() - kSpare, codes_.end(), kEnd);
  }

  /// Index of the first entry after `in`, at most `end`.
  std::size_t placeOf(const CodedSlot& in, std::size_t end, Count& count) const {
    const auto isAfter = [&](std::size_t i) {
      count.resort(1);
      return in < CodedSlot{codes_[i], slots_[i]};
    };
    std::size_t stride = 1;
    while (stride <= end && isAfter(end - stride)) {
      end -= stride;
      stride *= 2;
    }
    std::size_t low = end - std::min(end, stride - 1);
    while (low < end) {
      const std::size_t middle = low + (end - low) / 2;
      if (isAfter(middle))
        end = middle;
      else
        low = middle + 1;
    }
    return low;
  }

  std::vector<std::uint64_t> codes_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace yadefrag
