#pragma once
// Fourth part of code_search.hpp: from codes to pairs (paper §4.4).

#include <algorithm>
#include <cmath>

#include "search/code_search.hpp"
#include "search/numbering.hpp"

namespace yadefrag {

/// Pairs of the i-th box of a level with boxes of the `searched` levels, on its own one with later
/// boxes only, and with the wide boxes.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::pairsOf(int own, std::size_t i, std::span<const int> searched,
                                         RowBegins& begins, std::vector<BoxPair>& out,
                                         Count& count) const {
  const std::uint32_t slot = levels_[own].slot(i);
  const Box& box = boxes_[slot];
  const FilterBox filter = levels_[own].filter(i);
  const auto take = [&](std::uint32_t other) {
    out.push_back(orderedPair(BoxId(slot), BoxId(other)));
  };
  for (const int other : searched) {
    const Level& level = levels_[other];
    const auto test = [&](std::uint32_t begin, const CodeRange& range) {
      visitRange(level, filter, box, begin, range, count, take);
    };
    if (other != own)
      visitRectangle(box, other, &begins.of(other), count, test);
    else
      visitLaterNeighbours(level, own, i, count, test);
  }
  wide_.pairsWith(boxes_, box, slot, out, count);
}

/// Counts what the scan of a range compares.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::countRange(const Level& level, std::size_t begin,
                                            const CodeRange& range, Count& count) {
  if (count.isOn()) {
    count.range(1);
    for (std::size_t j = begin; level.codes()[j] <= range.stop; ++j) {
      if (level.codes()[j] < range.start) continue;
      count.range(1);
      count.test(2 * Dim);
    }
  }
}

/// Calls `visit(slot)` for the boxes of a range of codes, from index `begin` on, that overlap
/// `box`. Starting at the begin of a range, a linear scan reaches its end faster than a look-up.
template <class Numbering, int Dim>
template <class Visit>
void CodeSearch<Numbering, Dim>::visitRange(const Level& level, const FilterBox& filter,
                                            const Box& box, std::uint32_t begin,
                                            const CodeRange& range, Count& count,
                                            Visit visit) const {
  countRange(level, begin, range, count);
  level.forEachOverlap(box, filter, boxes_, begin, range.start, range.stop, visit);
}

/// Boxes of one level are shorter than an edge: boxes that overlap lie in the same position-code
/// box or in adjacent ones. Two comparisons per axis select these adjacent boxes; their codes
/// follow from the box's own code.
template <class Numbering, int Dim>
template <class Visit>
void CodeSearch<Numbering, Dim>::visitLaterNeighbours(const Level& level, int own, std::size_t i,
                                                      Count& count, Visit visit) const {
  const Box& box = boxes_[level.slot(i)];
  const std::uint64_t code = level.codes()[i];
  CodeRange corners = {code, code};
  for (int d = 0; d < Dim; ++d) {
    const int axis = grid_.axis(d);
    const auto floor = static_cast<double>(floorToInt(grid_.scaled(box.min[axis], own, d)));
    count.range(2);
    if (grid_.scaled(lowestStart(box, axis, own), own, d) < floor)
      corners.start = Numbering::down(corners.start, d);
    if (grid_.scaled(box.max[axis], own, d) >= floor + 1)
      corners.stop = Numbering::up(corners.stop, d);
  }
  const auto next = static_cast<std::uint32_t>(i) + 1;
  Numbering::forEachRange(corners.start, corners.stop, [&](const CodeRange& range) {
    count.range(2);
    if (range.stop < code) return;
    const std::uint32_t begin = range.start <= code ? next : lowerBound(level, range.start, count);
    visit(begin, range);
  });
}

/// Pairs of the boxes [from, to) of a level with later boxes of the level: those behind them in
/// their own row, and those in the adjacent later rows, at the shortest possible edge and without
/// comparisons of coordinates.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::sweepRows(int own, std::size_t from, std::size_t to,
                                           std::vector<BoxPair>& out, Count& count) const {
  const Level& level = levels_[own];
  const std::uint64_t* codes = level.codes().data();
  const InstructionSet set = bestInstructionSet();
  constexpr std::size_t width = FilterBlocks::kTogether;
  NearList near;
  std::vector<BlockRange> outer;
  std::array<BlockRange, Numbering::kLaterRows + 1> inner{};
  std::array<std::size_t, Numbering::kLaterRows> begins{};  // blocks in which the rows begin
  for (std::size_t i = from; i < to && !isFull(out); ++i) {
    const std::uint32_t slot = level.slot(i);
    const std::uint64_t code = codes[i];
    std::span<const BlockRange> ranges = inner;
    if (Numbering::isInner(code)) {
      inner[0] = {i + 1, {code, code + Numbering::kPartsOfX}};
      for (int k = 0; k < Numbering::kLaterRows; ++k) {
        const CodeRange row = Numbering::laterRow(code, k);
        std::size_t& begin = begins[k];
        while (codes[begin * width + width - 1] < row.start) ++begin;
        inner[k + 1] = {begin * width, row};
      }
    } else {
      outerRows(level, i, outer, count);
      ranges = outer;
    }
    for (const BlockRange& range : ranges) countRange(level, range.begin, range.codes, count);
    level.forEachOverlap(
        set, boxes_[slot], level.filter(i), boxes_, ranges, near,
        [&](std::uint32_t other) { out.push_back(orderedPair(BoxId(slot), BoxId(other))); });
  }
}

/// The ranges of neighbours of a box beside the end of a coordinate, where rows wrap around.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::outerRows(const Level& level, std::size_t i,
                                           std::vector<BlockRange>& ranges, Count& count) const {
  ranges.clear();
  const std::uint64_t code = level.codes()[i];
  CodeRange corners = {code, code};
  for (int d = 0; d < Dim; ++d)
    corners = {Numbering::down(corners.start, d), Numbering::up(corners.stop, d)};
  Numbering::forEachRange(corners.start, corners.stop, [&](const CodeRange& range) {
    if (range.stop < code) return;
    const std::size_t begin = range.start <= code ? i + 1 : lowerBound(level, range.start, count);
    ranges.push_back({begin, range});
  });
}

/// Visits all boxes of a level that can overlap `box`; it may visit others, too. `begins`: where
/// the rows of the last rectangle on this level began, if boxes are visited in their order.
template <class Numbering, int Dim>
template <class Visit>
void CodeSearch<Numbering, Dim>::visitRectangle(const Box& box, int at, RowBegins::OfLevel* begins,
                                                Count& count, Visit visit) const {
  const Level& level = levels_[at];
  CodeRange corners;
  const auto visitRange = [&](const CodeRange& range) {
    if constexpr (Numbering::kIsSwept) {
      if (begins) {
        const int row = Numbering::rowOf(range.start);
        return visit(begins->lowerBound(row, level.codes(), range.start, count), range);
      }
    }
    visit(lowerBound(level, range.start, count), range);
  };
  switch (rectangleOf(box, at, corners)) {
    case Extent::kSmall:
      Numbering::forEachRange(corners.start, corners.stop, visitRange);
      return;
    case Extent::kLarge:
      if constexpr (Numbering::kIsCurve) {
        Numbering::forEachRangeOfLarge(corners.start, corners.stop, visitRange);
        return;
      } else if (tolerance::kCodesPerRow * Numbering::rowsOf(corners.start, corners.stop) <
                 level.size()) {
        Numbering::forEachRange(corners.start, corners.stop, visitRange);
        return;
      }
      [[fallthrough]];  // a scan of all boxes is cheaper than thousands of rows
    case Extent::kWraps:
      visit(0, {0, SortedList::kEnd - 1});
      return;
  }
}

/// Lower bound of the lower corners of boxes of `level` that overlap `box`.
template <class Numbering, int Dim>
double CodeSearch<Numbering, Dim>::lowestStart(const Box& box, int axis, int level) const {
  const double extent = extents_[level];
  const double from = box.min[axis] - extent;
  return from - (std::abs(from) + extent) * tolerance::kExtentRounding;
}

/// Codes of the corners of the rectangle that contains the lower corners of all boxes of `level`
/// that can overlap `box`; no value if the rectangle is large and wraps around.
template <class Numbering, int Dim>
auto CodeSearch<Numbering, Dim>::rectangleOf(const Box& box, int level, CodeRange& corners) const
    -> Extent {
  Cell low;
  Cell high;
  bool wraps = false;
  double longest = 0;
  for (int d = 0; d < Dim; ++d) {
    const int axis = grid_.axis(d);
    const double from = grid_.scaled(lowestStart(box, axis, level), level, d);
    const double to = grid_.scaled(box.max[axis], level, d);
    longest = std::max(longest, to - from);
    if (!(to - from < (Code::kMask >> 1)) || !(std::abs(from) < 0x1p60)) return Extent::kWraps;
    const std::int64_t origin = grid_.origin(level, d);
    low[d] = static_cast<std::uint32_t>(floorToInt(from) - origin) & Code::kMask;
    high[d] = static_cast<std::uint32_t>(floorToInt(to) - origin) & Code::kMask;
    wraps |= low[d] > high[d];
  }
  corners = {Numbering::encode(low), Numbering::encode(high)};
  if (longest < tolerance::kSmallRectangle) return Extent::kSmall;
  return wraps ? Extent::kWraps : Extent::kLarge;
}

/// The Lebesgue search uses its directory; the linear search (LPC) searches its whole list (§4.5).
template <class Numbering, int Dim>
std::uint32_t CodeSearch<Numbering, Dim>::lowerBound(const Level& level, std::uint64_t code,
                                                     Count& count) const {
  if constexpr (Numbering::kIsCurve) return level.directory().lowerBound(code, count);
  return bisectCodes(level.codes(), 0, static_cast<std::uint32_t>(level.size()), code, count);
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::findOverlaps(const Box& box, std::vector<BoxId>& found) const {
  Count uncounted;
  const FilterBox filter = FilterBox::of(box, grid_.filterScale());
  for (const int at : occupied_) {
    const Level& level = levels_[at];
    visitRectangle(box, at, nullptr, uncounted, [&](std::uint32_t begin, const CodeRange& range) {
      level.forEachOverlap(box, filter, boxes_, begin, range.start, range.stop,
                           [&](std::uint32_t slot) { found.emplace_back(slot); });
    });
  }
  wide_.overlapsWith(boxes_, box, found, uncounted);
}

}  // namespace yadefrag
