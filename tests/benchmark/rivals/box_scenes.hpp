#pragma once
// Scenes of moving boxes for the comparison of searches.

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/box.hpp"
#include "core/ids.hpp"

namespace yadefrag {

/// Boxes that fill .3 of their cube (square) and move by up to a tenth of their sides at each step.
///   uniform    sides 1, anywhere
///   few move   the same, of which 1 % move
///   clusters   the same in a hundred heaps, far apart
///   sizes      sides from 1 to 1000, as many in each octave of the volume
///   slivers    one side fifty times as long as the others
class BoxScene {
 public:
  BoxScene(const std::string& name, int dimensions, std::size_t count) : dimensions_(dimensions) {
    const bool sizes = name == "sizes", slivers = name == "slivers", heaps = name == "clusters";
    few_ = name == "few move";
    if (!sizes && !slivers && !heaps && !few_ && name != "uniform")
      throw std::invalid_argument("no scene of this name");
    std::vector<std::array<double, 3>> sides(count, {0, 0, 0});
    double volume = 0;
    for (auto& side : sides) {
      const double length =
          sizes ? std::pow(1 + unit() * (std::pow(1000, -dimensions) - 1), -1. / dimensions) : 1;
      double own = 1;
      const int longAxis = static_cast<int>(unit() * dimensions);
      for (int axis = 0; axis < dimensions; ++axis)
        own *= side[axis] = length * (slivers && axis == longAxis ? 50 : 1);
      volume += own;
    }
    const double edge = std::pow(volume / .3, 1. / dimensions);
    const double heap = edge * std::pow(.01, 1. / dimensions);
    std::vector<std::array<double, 3>> centres(100);
    for (auto& centre : centres)
      for (int axis = 0; axis < dimensions; ++axis) centre[axis] = unit() * edge * 10;
    for (const auto& side : sides) {
      Box box{{0, 0, 0}, {0, 0, 0}};
      const auto& centre = centres[static_cast<std::size_t>(unit() * 100)];
      for (int axis = 0; axis < dimensions; ++axis) {
        box.min[axis] = heaps ? centre[axis] + heap * unit() : unit() * edge;
        box.max[axis] = box.min[axis] + side[axis];
      }
      boxes_.push_back(box);
    }
  }

  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

  /// Moves the boxes; returns which, ascending.
  const std::vector<BoxId>& step() {
    moved_.clear();
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (few_ && unit() > .01) continue;
      moved_.push_back(BoxId(i));
      for (int axis = 0; axis < dimensions_; ++axis) {
        const double side = boxes_[i].max[axis] - boxes_[i].min[axis];
        const double way = (unit() - .5) * .2 * side;
        boxes_[i].min[axis] += way;
        boxes_[i].max[axis] += way;
      }
    }
    return moved_;
  }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  int dimensions_;
  bool few_ = false;
  std::mt19937_64 random_{7};
  std::vector<Box> boxes_;
  std::vector<BoxId> moved_;
};

}  // namespace yadefrag
