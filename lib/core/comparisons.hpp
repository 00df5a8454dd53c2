#pragma once
// Counts comparisons as the paper does (§6): one comparison is that of two integers (list indices,
// codes) or of two coordinates.

#include <cstdint>

namespace yadefrag {

/// Comparisons of one search, by stage.
struct Comparisons {
  std::uint64_t move = 0;    ///< tests whether a box has left its position-code box, per level
  std::uint64_t resort = 0;  ///< sorting the list of codes again
  std::uint64_t range = 0;   ///< finding the ends of code ranges; overlap of tree nodes
  std::uint64_t test = 0;    ///< coordinates of the boxes of candidate pairs

  [[nodiscard]] std::uint64_t total() const { return move + resort + range + test; }
  Comparisons& operator+=(const Comparisons& o) {
    move += o.move, resort += o.resort, range += o.range, test += o.test;
    return *this;
  }
};

/// Policy of a search without counting: every call compiles to nothing.
struct CountNothing {
  static constexpr bool kOn = false;
  void move(std::uint64_t) {}
  void resort(std::uint64_t) {}
  void range(std::uint64_t) {}
  void test(std::uint64_t) {}
  [[nodiscard]] Comparisons total() const { return {}; }
  void merge(const CountNothing&) {}
};

/// Policy of a search with counting.
struct CountAll {
  static constexpr bool kOn = true;
  Comparisons sum;
  void move(std::uint64_t n) { sum.move += n; }
  void resort(std::uint64_t n) { sum.resort += n; }
  void range(std::uint64_t n) { sum.range += n; }
  void test(std::uint64_t n) { sum.test += n; }
  [[nodiscard]] Comparisons total() const { return sum; }
  void merge(const CountAll& o) { sum += o.sum; }
};

}  // namespace yadefrag
