#pragma once
// The ranges of the curve that cover a rectangle of boxes (paper §4.4, fig. 7).

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "curve/position_code.hpp"

namespace yadefrag {

/// A closed interval of position codes.
struct CodeRange {
  std::uint64_t start;
  std::uint64_t stop;
};

/// At most 2^Dim ranges without a common code, in no particular order.
template <int Dim>
struct CodeRanges {
  std::array<CodeRange, std::size_t{1} << Dim> range;
  int count = 0;
};

/// Closed interval of box numbers on one axis.
struct AxisInterval {
  std::uint32_t low;
  std::uint32_t high;
};

/// Cuts [low, high] where the highest-level boundary of the curve crosses it. A pair below one
/// parent box is left whole: the range is then at most twice as long, and there are half as many.
/// An interval that wraps (low > high) is cut at the wrap, which is the highest boundary of all.
template <int Dim>
int cutAtHighestBoundary(std::uint32_t low, std::uint32_t high, std::array<AxisInterval, 2>& part) {
  const std::uint32_t differing = low ^ high;
  if (low > high) {
    part = {{{low, PositionCode<Dim>::kMask}, {0, high}}};
    return 2;
  }
  if (differing <= 1) {
    part[0] = {low, high};
    return 1;
  }
  const int level = static_cast<int>(std::bit_width(differing)) - 1;
  const std::uint32_t boundary = (high >> level) << level;
  part = {{{low, boundary - 1}, {boundary, high}}};
  return 2;
}

/// Parts longer than a pair can give ranges that overlap: their codes vary on levels above the one
/// on which another axis was cut. Joins those.
template <int Dim>
void joinOverlapping(CodeRanges<Dim>& ranges) {
  const auto begin = ranges.range.begin();
  std::sort(begin, begin + ranges.count,
            [](const CodeRange& a, const CodeRange& b) { return a.start < b.start; });
  int kept = 0;
  for (int r = 1; r < ranges.count; ++r) {
    CodeRange& last = ranges.range[kept];
    if (ranges.range[r].start <= last.stop)
      last.stop = std::max(last.stop, ranges.range[r].stop);
    else
      ranges.range[++kept] = ranges.range[r];
  }
  ranges.count = kept + 1;
}

/// Ranges of all boxes with low ≤ box ≤ high on every axis (modulo 2^kBits), each clipped to the
/// codes of the lower-left and upper-right corner of its part. Other boxes may lie in a range too.
template <int Dim>
CodeRanges<Dim> rangesOfRectangle(const typename PositionCode<Dim>::Cell& low,
                                  const typename PositionCode<Dim>::Cell& high) {
  using Code = PositionCode<Dim>;
  struct SpreadPart {
    std::uint64_t low, high;
  };
  CodeRanges<Dim> out;
  out.range[0] = {0, 0};
  out.count = 1;
  bool onlyPairs = true;
  for (int axis = 0; axis < Dim; ++axis) {
    std::array<AxisInterval, 2> part;
    const int parts = cutAtHighestBoundary<Dim>(low[axis], high[axis], part);
    std::array<SpreadPart, 2> bits;
    for (int p = 0; p < parts; ++p) {
      bits[p].low = Code::spread(part[p].low) << Code::axisShift(axis);
      bits[p].high = Code::spread(part[p].high) << Code::axisShift(axis);
      onlyPairs &= part[p].high - part[p].low <= 1;
    }
    if (parts == 2)
      for (int r = 0; r < out.count; ++r)
        out.range[out.count + r] = {out.range[r].start | bits[1].low,
                                    out.range[r].stop | bits[1].high};
    for (int r = 0; r < out.count; ++r) {
      out.range[r].start |= bits[0].low;
      out.range[r].stop |= bits[0].high;
    }
    out.count *= parts;
  }
  if (!onlyPairs) joinOverlapping(out);
  return out;
}

}  // namespace yadefrag
