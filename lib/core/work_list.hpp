#pragma once
// Numbers that wait for work, one bit each. They are visited in order; a visit may add others.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/footprint.hpp"

namespace yadefrag {

/// One pass visits a number at most once. A number added ahead of the pass is visited in this pass,
/// one added behind it in the next pass.
class WorkList {
 public:
  /// Removes all, and makes room for numbers below `count`.
  void clear(std::size_t count) { words_.assign((count + 63) / 64, 0); }
  /// Makes room for numbers below `count`.
  void grow(std::size_t count) { words_.resize((count + 63) / 64); }
  void add(std::size_t number) { words_[number / 64] |= bit(number); }
  void remove(std::size_t number) { words_[number / 64] &= ~bit(number); }

  /// Removes the waiting numbers in ascending order, and calls `visit(number)` for each.
  template <class Visit>
  void visitUp(Visit visit) {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t waiting = words_[w] & ahead) {
        const auto at = static_cast<std::size_t>(std::countr_zero(waiting));
        ahead = ~std::uint64_t{1} << at;
        take(64 * w + at, visit);
      }
    }
  }
  /// The same in descending order.
  template <class Visit>
  void visitDown(Visit visit) {
    for (std::size_t w = words_.size(); w-- > 0;) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t waiting = words_[w] & ahead) {
        const auto at = static_cast<std::size_t>(63 - std::countl_zero(waiting));
        ahead = (std::uint64_t{1} << at) - 1;
        take(64 * w + at, visit);
      }
    }
  }

  void addTo(Footprint& footprint, Use use) const { footprint.add(use, words_); }

 private:
  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << number % 64; }

  template <class Visit>
  void take(std::size_t number, Visit visit) {
    remove(number);
    visit(number);
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace yadefrag
