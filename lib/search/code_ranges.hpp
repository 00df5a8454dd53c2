#pragma once
// The ranges of the curve that cover a rectangle of boxes (paper §4.4, fig. 7).
//
//           │            A rectangle that crosses boundaries of the curve in both directions: its
//      ┌────┼──┐         boxes are not consecutive on the curve. Cut at the highest boundary of
//      │ 2  │ 4│         each axis it has four parts at most. The boxes of each part are in one
//   ───┼────┼──┼───      range of codes, from that of the part's lower-left corner to that of its
//      │ 1  │ 3│         upper-right one; a range may contain boxes outside the part.
//      └────┼──┘
//           │

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/tolerances/search.hpp"
#include "search/position_code.hpp"

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

/// Cuts an axis' interval [low, high] at the highest-level boundary of the curve inside it. All
/// numbers are an axis' bits at their places within a code, `unit` is the lowest of these bits, so
/// that comparisons and cuts need no unpacking. An interval of two boxes below one parent box is
/// not cut: the range is then at most twice as long, and there are half as many ranges. An interval
/// that wraps around (low > high) is cut where it wraps, at the highest boundary of all.
inline int cutAtHighestBoundary(const CodeRange& axis, std::uint64_t mask, std::uint64_t unit,
                                std::array<CodeRange, 2>& part) {
  const std::uint64_t differing = axis.start ^ axis.stop;
  if (axis.start > axis.stop) {
    part = {{{axis.start, mask}, {0, axis.stop}}};
    return 2;
  }
  if (differing <= unit) {
    part[0] = axis;
    return 1;
  }
  const std::uint64_t boundary = axis.stop & ~(std::bit_floor(differing) - 1);
  part = {{{axis.start, (boundary - unit) & mask}, {boundary, axis.stop}}};
  return 2;
}

/// By insertion: there are at most 2^Dim. GCC 13 and later take std::sort's branch for more than
/// sixteen for a read past the last one.
template <int Dim>
void sortByStart(CodeRanges<Dim>& ranges) {
  auto& range = ranges.range;
  for (int r = 1; r < ranges.count; ++r)
    for (int at = r; at > 0 && range[at].start < range[at - 1].start; --at)
      std::swap(range[at], range[at - 1]);
}

/// Parts longer than two boxes can give overlapping ranges: their codes vary on levels above the
/// one on which another axis was cut. This function joins such ranges.
template <int Dim>
void joinOverlapping(CodeRanges<Dim>& ranges) {
  sortByStart(ranges);
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

/// Ranges of all boxes of the rectangle (modulo 2^kBits per axis) between two corners, which are
/// given by their codes. Each range is clipped to the codes of its part's lower-left and
/// upper-right corner. A range may also contain other boxes.
template <int Dim>
CodeRanges<Dim> rangesOfRectangle(std::uint64_t low, std::uint64_t high) {
  using Code = PositionCode<Dim>;
  CodeRanges<Dim> out;
  out.range[0] = {0, 0};
  out.count = 1;
  bool onlyPairs = true;
  for (int axis = 0; axis < Dim; ++axis) {
    constexpr std::uint64_t one = 1;
    const std::uint64_t mask = Code::axisMask(axis);
    const std::uint64_t unit = one << Code::axisShift(axis);
    std::array<CodeRange, 2> part;
    const int parts = cutAtHighestBoundary({low & mask, high & mask}, mask, unit, part);
    for (int p = 0; p < parts; ++p) onlyPairs &= (part[p].start ^ part[p].stop) <= unit;
    if (parts == 2)
      for (int r = 0; r < out.count; ++r)
        out.range[out.count + r] = {out.range[r].start | part[1].start,
                                    out.range[r].stop | part[1].stop};
    for (int r = 0; r < out.count; ++r) {
      out.range[r].start |= part[0].start;
      out.range[r].stop |= part[0].stop;
    }
    out.count *= parts;
  }
  if (!onlyPairs) joinOverlapping(out);
  return out;
}

/// Ranges of a rectangle of any shape and size, in the order of the curve. The rectangle is cut
/// until no range contains more than kCodesPerBox codes per box of the range. The cut is along the
/// axis of the highest bit in which the corners differ: the two parts are then separate on the
/// curve.
template <int Dim, class Visit>
void forEachRangeOfLarge(std::uint64_t low, std::uint64_t high, Visit& visit) {
  using Code = PositionCode<Dim>;
  std::uint64_t boxes = 1;
  for (int axis = 0; axis < Dim; ++axis)
    boxes *= Code::gather(high >> Code::axisShift(axis)) -
             Code::gather(low >> Code::axisShift(axis)) + std::uint64_t{1};
  if ((high - low) / tolerance::kCodesPerBox < boxes) {
    visit(CodeRange{low, high});
    return;
  }
  const int bit = static_cast<int>(std::bit_width(low ^ high)) - 1;
  const int axis = Dim - 1 - bit % Dim;
  const std::uint64_t mask = Code::axisMask(axis);
  const std::uint64_t unit = std::uint64_t{1} << Code::axisShift(axis);
  const std::uint64_t boundary = (high & mask) & ~((std::uint64_t{1} << bit) - 1);
  forEachRangeOfLarge<Dim>(low, (high & ~mask) | ((boundary - unit) & mask), visit);
  forEachRangeOfLarge<Dim>((low & ~mask) | boundary, high, visit);
}

}  // namespace yadefrag
