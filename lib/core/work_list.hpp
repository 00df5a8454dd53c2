#pragma once
// Numbers that wait for work, one bit each. They are visited in order; a visit may add others.

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yadefrag {

/// One pass visits a number at most once. A number added ahead of the pass is visited in this pass,
/// one added behind it in the next pass.
class WorkList {
 public:
  /// Numbers that share no word with others: several threads may change one range each.
  struct Range {
    std::size_t begin, end;  ///< words
  };
  static constexpr std::size_t kPerWord = 64;
  /// Number of words for so many numbers.
  static constexpr std::size_t wordsFor(std::size_t count) {
    return (count + kPerWord - 1) / kPerWord;
  }

  /// Removes all, and makes room for numbers below `count`.
  void clear(std::size_t count) { words_.assign(wordsFor(count), 0); }
  /// Makes room for numbers below `count`.
  void grow(std::size_t count) { words_.resize(wordsFor(count)); }
  void add(std::size_t number) {
    assert(number / kPerWord < words_.size());
    words_[number / kPerWord] |= bit(number);
  }
  [[nodiscard]] bool contains(std::size_t number) const {
    assert(number / kPerWord < words_.size());
    return (words_[number / kPerWord] & bit(number)) != 0;
  }
  void remove(std::size_t number) {
    assert(number / kPerWord < words_.size());
    words_[number / kPerWord] &= ~bit(number);
  }

  /// Removes the waiting numbers in ascending order, and calls `visit(number)` for each.
  template <class Visit>
  void visitUp(Visit visit) {
    visitUp(all(), visit);
  }
  template <class Visit>
  void visitUp(Range range, Visit visit) {
    assert(range.begin <= range.end && range.end <= words_.size());
    for (std::size_t w = range.begin; w < range.end; ++w) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t waiting = words_[w] & ahead) {
        const auto at = static_cast<std::size_t>(std::countr_zero(waiting));
        ahead = ~std::uint64_t{1} << at;
        take(kPerWord * w + at, visit);
      }
    }
  }
  /// Removes the waiting numbers in descending order, and calls `visit(number)` for each.
  template <class Visit>
  void visitDown(Visit visit) {
    visitDown(all(), visit);
  }
  template <class Visit>
  void visitDown(Range range, Visit visit) {
    assert(range.begin <= range.end && range.end <= words_.size());
    for (std::size_t w = range.end; w-- > range.begin;) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t waiting = words_[w] & ahead) {
        const auto at = kPerWord - 1 - static_cast<std::size_t>(std::countl_zero(waiting));
        ahead = (std::uint64_t{1} << at) - 1;
        take(kPerWord * w + at, visit);
      }
    }
  }

  [[nodiscard]] Range all() const { return {0, words_.size()}; }

 private:
  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << number % kPerWord; }

  template <class Visit>
  void take(std::size_t number, Visit visit) {
    remove(number);
    visit(number);
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace yadefrag
