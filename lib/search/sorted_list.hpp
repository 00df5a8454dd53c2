#pragma once
// The sorted list of codes that a search keeps from one update to the next.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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
template <class Count>
std::uint32_t bisectCodes(std::span<const std::uint64_t> codes, std::uint32_t begin,
                          std::uint32_t end, std::uint64_t code, Count& count) {
  const auto isBelow = [&](std::uint64_t a, std::uint64_t b) {
    count.range(1);
    return a < b;
  };
  const auto first = codes.begin();
  return static_cast<std::uint32_t>(std::lower_bound(first + begin, first + end, code, isBelow) -
                                    first);
}

/// Sorts a list that ascends in slot (radix sort: stable, without comparisons).
void sortByCode(std::vector<CodedSlot>& list);

/// Merges the sorted list `incoming` into the sorted list `list`. The position of each new entry is
/// found from the previous one by exponential, then binary search (paper §4.4, lemma A.2). The
/// number of comparisons grows with the gaps between the new entries, not with the length of the
/// list; every entry is shifted once.
template <class Count>
void mergeByCode(std::vector<CodedSlot>& list, const std::vector<CodedSlot>& incoming,
                 std::vector<CodedSlot>& scratch, Count& count) {
  scratch.clear();
  scratch.reserve(list.size() + incoming.size());
  std::size_t from = 0;
  for (const CodedSlot& in : incoming) {
    std::size_t low = from;
    std::size_t stride = 1;
    while (low + stride <= list.size() && list[low + stride - 1] < in) {
      count.resort(1);
      low += stride;
      stride *= 2;
    }
    std::size_t high = std::min(list.size(), low + stride - 1);
    count.resort(1);
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      count.resort(1);
      if (list[middle] < in)
        low = middle + 1;
      else
        high = middle;
    }
    scratch.insert(scratch.end(), list.begin() + from, list.begin() + low);
    scratch.push_back(in);
    from = low;
  }
  scratch.insert(scratch.end(), list.begin() + from, list.end());
  list.swap(scratch);
}

}  // namespace yadefrag
