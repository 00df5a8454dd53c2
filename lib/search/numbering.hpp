#pragma once
// The numberings of position-code boxes: along the Lebesgue curve (SPC, paper §4.2) and row by row
// (LPC, Oldenburg and Nilsson 1994, the paper's [5]), the latter also for sweeps. All count
// coordinates modulo 2^kBits. Distant boxes can therefore have the same code, which adds a
// candidate and loses none.

#include "core/tolerances/search.hpp"
#include "search/code_ranges.hpp"
#include "search/position_code.hpp"

namespace yadefrag {

template <int Dim>
struct LebesgueNumbering {
  using Code = PositionCode<Dim>;
  using Cell = typename Code::Cell;
  static constexpr bool kIsCurve = true;
  static constexpr bool kIsSwept = false;
  static constexpr double kEdgeOverExtent = tolerance::kEdgeOverExtent;
  static constexpr int kPartsOfX = 1;
  static constexpr std::int64_t kFirst = 0;  ///< number of the boxes at the origin

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

  /// Visits the ranges of a rectangle of any size that does not wrap around.
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
  static constexpr bool kIsSwept = false;
  static constexpr double kEdgeOverExtent = tolerance::kEdgeOverExtent;
  static constexpr int kPartsOfX = 1;
  static constexpr std::int64_t kFirst = 0;

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

  /// The row of a code, modulo 64: different for rows less than eight apart along each axis.
  static int rowOf(std::uint64_t code) {
    const std::uint64_t y = code >> Code::kBits;
    if constexpr (Dim == 2) return static_cast<int>(y & 63);
    return static_cast<int>((y & 7) | ((y >> Code::kBits) & 7) << 3);
  }

  /// Number of rows of a rectangle that does not wrap around.
  static std::uint64_t rowsOf(std::uint64_t lowCode, std::uint64_t highCode) {
    const Cell low = decode(lowCode);
    const Cell high = decode(highCode);
    std::uint64_t rows = 1;
    for (int axis = 1; axis < Dim; ++axis) rows *= high[axis] - low[axis] + std::uint64_t{1};
    return rows;
  }

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

 protected:
  static std::uint64_t stepped(std::uint64_t code, int axis, std::uint32_t by) {
    Cell cell = decode(code);
    cell[axis] = (cell[axis] + by) & Code::kMask;
    return encode(cell);
  }
};

/// Row by row, for a search that visits all boxes in their order: the boxes of the adjacent rows
/// then come in their order, too, so that each of these rows is found by a few steps from where it
/// was left (lemma A.3 with a distance of about one), without a look-up. The origin lies inside the
/// numbered area: rows wrap around far from all boxes.
template <int Dim>
struct SweptRows : LinearNumbering<Dim> {
  using Base = LinearNumbering<Dim>;
  using Code = PositionCode<Dim>;
  static constexpr bool kIsSwept = true;
  static constexpr double kEdgeOverExtent = tolerance::kRowEdgeOverExtent;
  static constexpr int kPartsOfX = tolerance::kPartsOfX;  ///< boxes per edge along a row
  static constexpr std::int64_t kFirst = std::int64_t{1} << (Code::kBits - 2);

  /// Number of adjacent rows whose codes are greater than those of a row.
  static constexpr int kLaterRows = Dim == 2 ? 1 : 4;

  static std::uint64_t down(std::uint64_t code, int axis) {
    return Base::stepped(code, axis, axis == 0 ? Code::kMask + 1 - kPartsOfX : Code::kMask);
  }
  static std::uint64_t up(std::uint64_t code, int axis) {
    return Base::stepped(code, axis, axis == 0 ? kPartsOfX : 1);
  }

  /// True if no adjacent box is beyond the end of a coordinate.
  static bool isInner(std::uint64_t code) {
    for (int axis = 0; axis < Dim; ++axis) {
      const auto at = static_cast<std::uint32_t>(code >> (axis * Code::kBits)) & Code::kMask;
      const std::uint32_t edge = axis == 0 ? kPartsOfX : 1;
      if (at < edge || at > Code::kMask - edge) return false;
    }
    return true;
  }
  /// The boxes of the k-th of these rows within an edge of the box `code`, if it is inner.
  static CodeRange laterRow(std::uint64_t code, int k) {
    constexpr std::uint64_t y = std::uint64_t{1} << Code::kBits;
    std::uint64_t middle = code + y;
    if constexpr (Dim == 3) {
      constexpr std::uint64_t z = y << Code::kBits;
      if (k > 0) middle = code + z + static_cast<std::uint64_t>(k - 2) * y;
    }
    return {middle - kPartsOfX, middle + kPartsOfX};
  }
};

}  // namespace yadefrag
