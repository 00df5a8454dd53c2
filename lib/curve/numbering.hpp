#pragma once
// The two numberings of position-code boxes: along the Lebesgue curve (SPC, paper §4.2) and row by
// row (LPC, Oldenburg and Nilsson 1994, the paper's [5]). Both count coordinates modulo 2^kBits.
// Distant boxes can therefore have the same code, which adds a candidate and loses none.

#include "curve/code_ranges.hpp"
#include "curve/position_code.hpp"

namespace yadefrag {

template <int Dim>
struct LebesgueNumbering {
  using Code = PositionCode<Dim>;
  using Cell = typename Code::Cell;
  static constexpr bool kIsCurve = true;

  static std::uint64_t encode(const Cell& cell) { return Code::encode(cell); }

  /// Code of the previous or next box along an axis, by arithmetic on that axis' bits in place.
  static std::uint64_t down(std::uint64_t code, int axis) {
    const std::uint64_t mask = Code::axisMask(axis);
    return (code & ~mask) | (((code & mask) - (std::uint64_t{1} << Code::axisShift(axis))) & mask);
  }
  static std::uint64_t up(std::uint64_t code, int axis) {
    const std::uint64_t mask = Code::axisMask(axis);
    return (code & ~mask) | (((code | ~mask) + (std::uint64_t{1} << Code::axisShift(axis))) & mask);
  }

  /// Visits the ranges of the rectangle between two corners, which are given by their codes.
  template <class Visit>
  static void forEachRange(std::uint64_t low, std::uint64_t high, Visit visit) {
    const CodeRanges<Dim> ranges = rangesOfRectangle<Dim>(low, high);
    for (int r = 0; r < ranges.count; ++r) visit(ranges.range[r]);
  }

  /// The same for a rectangle of any size that does not wrap around.
  template <class Visit>
  static void forEachRangeOfLarge(std::uint64_t low, std::uint64_t high, Visit visit) {
    yadefrag::forEachRangeOfLarge<Dim>(low, high, visit);
  }
};

template <int Dim>
struct LinearNumbering {
  using Code = PositionCode<Dim>;
  using Cell = typename Code::Cell;
  static constexpr bool kIsCurve = false;

  /// Rows run along x, the first axis; each row has 2^kBits boxes.
  static std::uint64_t encode(const Cell& cell) {
    std::uint64_t code = 0;
    for (int axis = Dim - 1; axis >= 0; --axis) code = (code << Code::kBits) | cell[axis];
    return code;
  }
  static Cell decode(std::uint64_t code) {
    Cell cell;
    for (int axis = 0; axis < Dim; ++axis)
      cell[axis] = static_cast<std::uint32_t>(code >> (axis * Code::kBits)) & Code::kMask;
    return cell;
  }

  static std::uint64_t down(std::uint64_t code, int axis) {
    return stepped(code, axis, Code::kMask);
  }
  static std::uint64_t up(std::uint64_t code, int axis) { return stepped(code, axis, 1); }

  /// One range per row of the rectangle; two if the row wraps around.
  template <class Visit>
  static void forEachRange(std::uint64_t lowCode, std::uint64_t highCode, Visit visit) {
    const Cell low = decode(lowCode);
    const Cell high = decode(highCode);
    Cell row = low;
    for (;;) {
      row[0] = 0;
      const std::uint64_t base = encode(row);
      if (low[0] <= high[0]) {
        visit(CodeRange{base | low[0], base | high[0]});
      } else {
        visit(CodeRange{base, base | high[0]});
        visit(CodeRange{base | low[0], base | Code::kMask});
      }
      int axis = 1;
      for (; axis < Dim; ++axis) {
        if (row[axis] != high[axis]) {
          row[axis] = (row[axis] + 1) & Code::kMask;
          break;
        }
        row[axis] = low[axis];
      }
      if (axis == Dim) return;
    }
  }

 private:
  static std::uint64_t stepped(std::uint64_t code, int axis, std::uint32_t by) {
    Cell cell = decode(code);
    cell[axis] = (cell[axis] + by) & Code::kMask;
    return encode(cell);
  }
};

}  // namespace yadefrag
