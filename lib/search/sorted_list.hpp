#pragma once
// The sorted list of codes that a search keeps from one update to the next.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace yadefrag {

struct CodedSlot {
  std::uint64_t code;
  std::uint32_t slot;

  /// By slot where codes are equal: the order then does not depend on who came first.
  friend bool operator<(const CodedSlot& a, const CodedSlot& b) {
    return a.code != b.code ? a.code < b.code : a.slot < b.slot;
  }
};

/// Sorts a list that is ascending in slot (radix sort: stable, no comparisons).
void sortByCode(std::vector<CodedSlot>& list);

/// Merges `incoming`, sorted, into `list`, sorted. For each one coming in, the place is found from
/// the one before by exponential, then binary search (paper §4.4, lemma A.2): comparisons grow with
/// the gaps between those that moved and not with the length of the list, and every entry is
/// shifted once.
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
