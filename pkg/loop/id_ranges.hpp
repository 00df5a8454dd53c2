#pragma once
// Sets of bodies as ranges of ids.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace yadefrag {

struct IdRange {
  std::size_t begin, end;
};

/// In ascending order, apart from each other.
using IdRanges = std::vector<IdRange>;

/// The ids below `count` for which `isIn(id)`.
template <class IsIn>
IdRanges rangesWhere(std::size_t count, const IsIn& isIn) {
  IdRanges ranges;
  for (std::size_t id = 0; id < count; ++id) {
    if (!isIn(id)) continue;
    if (ranges.empty() || ranges.back().end != id) ranges.push_back({id, id});
    ++ranges.back().end;
  }
  return ranges;
}

/// Calls `work(begin, end)` for the parts of [begin, end) outside the ranges.
template <class Work>
[[gnu::always_inline]] inline void forOutside(const IdRanges& ranges, std::size_t begin,
                                              std::size_t end, const Work& work) {
  const auto endsBefore = [](const IdRange& range, std::size_t id) { return range.end <= id; };
  auto range = std::lower_bound(ranges.begin(), ranges.end(), begin, endsBefore);
  for (; range != ranges.end() && range->begin < end; ++range) {
    if (begin < range->begin) work(begin, range->begin);
    begin = range->end;
  }
  if (begin < end) work(begin, end);
}

}  // namespace yadefrag
