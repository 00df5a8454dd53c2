#pragma once
// Sweep-and-prune with counted comparisons: what YADE's InsertionSortCollider does (three axes kept
// in order by insertion sort, an overlap test where a lower bound passes an upper one), for the
// counts that its own code does not give. Its time is not YADE's; that is measured inside YADE.

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "core/comparisons.hpp"
#include "figure14/point_search.hpp"

namespace yadefrag::figure14 {

class SweepAndPrune {
 public:
  void update(const std::vector<Rectangle>& boxes) {
    boxes_ = &boxes;
    if (axes_[0].size() != 2 * boxes.size()) start();
    for (int axis = 0; axis < 3; ++axis) sort(axis);
  }

  [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }
  [[nodiscard]] Comparisons comparisons() const { return count_.total(); }

 private:
  struct Bound {
    double at;
    std::uint32_t box;
    bool isLow;
  };

  void start() {
    for (std::vector<Bound>& axis : axes_) {
      axis.clear();
      for (std::uint32_t i = 0; i < boxes_->size(); ++i) {
        axis.push_back({0, i, true});
        axis.push_back({0, i, false});
      }
    }
    pairs_.clear();
    for (int axis = 0; axis < 3; ++axis) {
      setCoordinates(axis);
      std::stable_sort(axes_[axis].begin(), axes_[axis].end(),
                       [](const Bound& a, const Bound& b) { return isBefore(a, b); });
    }
    for (std::uint32_t i = 0; i < boxes_->size(); ++i)
      for (std::uint32_t j = i + 1; j < boxes_->size(); ++j)
        if (overlap(i, j)) pairs_.insert(keyOf(i, j));
  }

  void setCoordinates(int axis) {
    for (Bound& bound : axes_[axis]) {
      const Rectangle& box = (*boxes_)[bound.box];
      const Vec2 corner = bound.isLow ? box.low : box.high;
      bound.at = axis == 0 ? corner.x : axis == 1 ? corner.y : 0;
    }
  }

  /// A lower bound goes before an upper one at the same place: touching boxes overlap.
  static bool isBefore(const Bound& a, const Bound& b) {
    return a.at < b.at || (a.at == b.at && a.isLow && !b.isLow);
  }

  void sort(int axis) {
    setCoordinates(axis);
    std::vector<Bound>& list = axes_[axis];
    for (std::size_t i = 1; i < list.size(); ++i) {
      const Bound moving = list[i];
      std::size_t to = i;
      for (; to > 0; --to) {
        count_.resort(1);
        if (!isBefore(moving, list[to - 1])) break;
        pass(moving, list[to - 1]);
        list[to] = list[to - 1];
      }
      list[to] = moving;
    }
  }

  /// `moving` goes below `other`.
  void pass(const Bound& moving, const Bound& other) {
    if (moving.isLow == other.isLow || moving.box == other.box) return;
    if (!moving.isLow) {
      pairs_.erase(keyOf(moving.box, other.box));
      return;
    }
    count_.test(4);  // the third axis is flat
    if (overlap(moving.box, other.box)) pairs_.insert(keyOf(moving.box, other.box));
  }

  [[nodiscard]] bool overlap(std::uint32_t i, std::uint32_t j) const {
    const Rectangle &a = (*boxes_)[i], &b = (*boxes_)[j];
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
  }
  static std::uint64_t keyOf(std::uint32_t i, std::uint32_t j) {
    return i < j ? std::uint64_t{i} << 32 | j : std::uint64_t{j} << 32 | i;
  }

  const std::vector<Rectangle>* boxes_ = nullptr;
  std::array<std::vector<Bound>, 3> axes_;
  std::unordered_set<std::uint64_t> pairs_;
  Count count_{true};
};

}  // namespace yadefrag::figure14
