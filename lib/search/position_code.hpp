#pragma once
// Position codes on the Lebesgue (Morton, Z-order) curve: paper §4.2 (numbering), fig. 6 (moves),
// §4.4 (start and stop codes).
//
//   2D, 31 bits an axis:   0 … x2 y2 x1 y1 x0 y0
//   3D, 21 bits an axis:   0 … x1 y1 z1 x0 y0 z0
//
// Fig. 5: the search area is divided into quarters, and each quarter again. The code of a box is
// that of its quarter with two more bits; the curve visits the boxes in the order of their codes.
//
//   01 11          0101 0111 │ 1101 1111
//   00 10          0100 0110 │ 1100 1110
//                  ──────────┼──────────
//                  0001 0011 │ 1001 1011
//                  0000 0010 │ 1000 1010
//
// Fig. 6: a box with L boxes on its left moves to the right by one box. The lowest i + 1 bits of L
// change, where i is the lowest set bit of L + 1 (of L for a move to the left). In the code these
// are every second bit: one XOR with the mask (10)^(i+1), or (01)^(i+1) along y.
//
// Laws (tests/search/position_code_test.cpp):
//   decode(encode(c)) = c;  encode is monotone in every coordinate;
//   encode(c ± 1 on one axis) = step(encode(c)), with the coordinates counted modulo 2^kBits;
//   startCode(e, i) … stopCode(e, i) are exactly the codes of the block of side 2^i around e.

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>

namespace yadefrag {

template <int Dim>
struct PositionCode {
  static_assert(Dim == 2 || Dim == 3);
  static constexpr int kBits = Dim == 2 ? 31 : 21;
  static constexpr std::uint32_t kMask = (std::uint32_t{1} << kBits) - 1;
  using Cell = std::array<std::uint32_t, Dim>;

  /// Puts Dim − 1 zeros in front of every bit, by shifts and masks. The instruction `pdep` is as
  /// fast, but not every processor that Debian supports has it.
  static constexpr std::uint64_t spread(std::uint32_t v) {
    std::uint64_t x = v & kMask;
    if constexpr (Dim == 2) {
      x = (x | (x << 16)) & 0x0000ffff0000ffffULL;
      x = (x | (x << 8)) & 0x00ff00ff00ff00ffULL;
      x = (x | (x << 4)) & 0x0f0f0f0f0f0f0f0fULL;
      x = (x | (x << 2)) & 0x3333333333333333ULL;
      x = (x | (x << 1)) & 0x5555555555555555ULL;
    } else {
      x = (x | (x << 32)) & 0x001f00000000ffffULL;
      x = (x | (x << 16)) & 0x001f0000ff0000ffULL;
      x = (x | (x << 8)) & 0x100f00f00f00f00fULL;
      x = (x | (x << 4)) & 0x10c30c30c30c30c3ULL;
      x = (x | (x << 2)) & 0x1249249249249249ULL;
    }
    return x;
  }

  /// The inverse of `spread`; bits in between are ignored.
  static constexpr std::uint32_t gather(std::uint64_t x) {
    if constexpr (Dim == 2) {
      x &= 0x5555555555555555ULL;
      x = (x | (x >> 1)) & 0x3333333333333333ULL;
      x = (x | (x >> 2)) & 0x0f0f0f0f0f0f0f0fULL;
      x = (x | (x >> 4)) & 0x00ff00ff00ff00ffULL;
      x = (x | (x >> 8)) & 0x0000ffff0000ffffULL;
      x = (x | (x >> 16)) & 0x00000000ffffffffULL;
    } else {
      x &= 0x1249249249249249ULL;
      x = (x | (x >> 2)) & 0x10c30c30c30c30c3ULL;
      x = (x | (x >> 4)) & 0x100f00f00f00f00fULL;
      x = (x | (x >> 8)) & 0x001f0000ff0000ffULL;
      x = (x | (x >> 16)) & 0x001f00000000ffffULL;
      x = (x | (x >> 32)) & 0x00000000001fffffULL;
    }
    return static_cast<std::uint32_t>(x) & kMask;
  }

  /// The axis x has the highest bit of each group (fig. 5).
  static constexpr int axisShift(int axis) { return Dim - 1 - axis; }

  static constexpr std::uint64_t encode(const Cell& cell) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < Dim; ++axis) code |= spread(cell[axis]) << axisShift(axis);
    return code;
  }

  static constexpr Cell decode(std::uint64_t code) {
    Cell cell{};
    for (int axis = 0; axis < Dim; ++axis) cell[axis] = gather(code >> axisShift(axis));
    return cell;
  }

  /// The mask (10)^(level+1), or (01)^(level+1) for y: flips an axis' bits 0 … level (fig. 6).
  static constexpr std::uint64_t flipMask(int axis, int level) {
    return spread((std::uint32_t{2} << level) - 1) << axisShift(axis);
  }

  /// Fig. 6, down: the lowest set bit of L is the level of the boundary that is crossed. At L = 0
  /// the coordinate wraps around; the paper excludes that by free space around the mesh.
  static constexpr std::uint64_t stepDown(std::uint64_t code, int axis, std::uint32_t l) {
    l &= kMask;
    return code ^ flipMask(axis, l == 0 ? kBits - 1 : std::countr_zero(l));
  }

  /// Fig. 6, up: the same with L + 1.
  static constexpr std::uint64_t stepUp(std::uint64_t code, int axis, std::uint32_t l) {
    l = (l + 1) & kMask;
    return code ^ flipMask(axis, l == 0 ? kBits - 1 : std::countr_zero(l));
  }

  /// All bits of one axis.
  static constexpr std::uint64_t axisMask(int axis) { return flipMask(axis, kBits - 1); }

  /// First and last code of the block of side 2^i that contains the box of `code` (§4.4).
  static constexpr std::uint64_t startCode(std::uint64_t code, int i) {
    return code & ~((std::uint64_t{1} << (Dim * i)) - 1);
  }
  static constexpr std::uint64_t stopCode(std::uint64_t code, int i) {
    return code | ((std::uint64_t{1} << (Dim * i)) - 1);
  }
};

}  // namespace yadefrag
