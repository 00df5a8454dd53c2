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

/// The counter of a search, or of one of its threads. On lines of its own, so that threads do not
/// share one.
class alignas(64) Count {
 public:
  explicit Count(bool isOn = false) : isOn_(isOn) {}

  /// For comparisons that must be found out first; the others are added always, which costs less
  /// than to ask.
  [[nodiscard]] bool isOn() const { return isOn_; }
  void move(std::uint64_t n) { sum_.move += n; }
  void resort(std::uint64_t n) { sum_.resort += n; }
  void range(std::uint64_t n) { sum_.range += n; }
  void test(std::uint64_t n) { sum_.test += n; }
  void merge(const Count& o) { sum_ += o.sum_; }
  [[nodiscard]] Comparisons total() const { return isOn_ ? sum_ : Comparisons{}; }

 private:
  Comparisons sum_;
  bool isOn_;
};

}  // namespace yadefrag
