#pragma once
// Random boxes of every kind that a search must get right.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/box.hpp"

namespace yadefrag {

class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    scale_ = std::pow(10, static_cast<double>(random_() % 19) - 9);
    ratio_ = std::pow(10, unit() * 4);
    flatAxis_ = random_() % 3 == 0 ? static_cast<int>(random_() % 3) : -1;
    place_ = static_cast<Place>(random_() % 5);
    walls_ = random_() % 4 == 0;
    offset_ = random_() % 4 == 0 ? scale_ * 1e3 * (unit() - .5) : 0;
    const std::size_t most = random_() % 20 == 0 ? 300 : 40;
    resize(random_() % most);
  }

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Boxes drift, jump, vanish, appear and change size; the array changes its length.
  void step() {
    for (Box& box : boxes_) {
      const auto what = random_() % 16;
      if (what == 0) {
        box = Box::absent();
      } else if (what <= 2 || box.isAbsent()) {
        box = randomBox();
      } else if (what <= 10) {
        for (int axis = 0; axis < 3; ++axis) {
          const double by = (unit() - .5) * scale_ * .02;
          box.min[axis] += by;
          box.max[axis] += by;
        }
        for (int axis = 0; axis < 3; ++axis)
          if (box.min[axis] > box.max[axis]) box.max[axis] = box.min[axis];  // rounding of points
      }
    }
    if (random_() % 3 == 0)
      resize(boxes_.size() + random_() % 7 - std::min<std::size_t>(3, boxes_.size()));
  }

 private:
  enum Place { kEven, kClusters, kLattice, kCoincident, kLine };

  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  void resize(std::size_t count) {
    boxes_.resize(std::min(count, boxes_.size()));
    while (boxes_.size() < count) boxes_.push_back(random_() % 20 ? randomBox() : Box::absent());
  }

  double coordinate(int axis) {
    if (axis == flatAxis_) return 0;
    switch (place_) {
      case kClusters:
        return scale_ * ((random_() % 2 ? 100 : 0) + .1 * unit());
      case kLattice:
        return scale_ * .125 * static_cast<double>(random_() % 8);  // on borders
      case kCoincident:
        return scale_ * .5 * static_cast<double>(random_() % 2);
      case kLine:
        return axis == 0 ? scale_ * unit() : scale_ * .25;
      case kEven:
        break;
    }
    return scale_ * (unit() - .5);
  }

  Box randomBox() {
    Box box;
    const bool point = random_() % 8 == 0;
    const double size = point ? 0 : .15 * scale_ * std::pow(ratio_, -unit());
    const bool cube = random_() % 2;
    const double half = place_ == kLattice ? .0625 * scale_ : .5 * size;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = coordinate(axis) + offset_;
      const double reach = point ? 0 : half * (cube ? 1 : unit());
      box.min[axis] = at - reach;
      box.max[axis] = at + reach;
    }
    if (walls_ && random_() % 10 == 0) {
      const auto axis = random_() % 3;
      box.min[axis] = -std::numeric_limits<double>::infinity();
      if (random_() % 2) box.max[axis] = std::numeric_limits<double>::infinity();
    }
    return box;
  }

  std::mt19937_64 random_;
  std::vector<Box> boxes_;
  double scale_ = 1, ratio_ = 1, offset_ = 0;
  int flatAxis_ = -1;
  Place place_ = kEven;
  bool walls_ = false;
};

}  // namespace yadefrag
