// A cell list: the plain grid of molecular dynamics, with cells as long as the longest box.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "benchmark/rivals/rival.hpp"
#include "search/search_plan.hpp"

namespace yadefrag {
namespace {

class Cells final : public Rival {
 public:
  explicit Cells(int dimensions) : dimensions_(dimensions) {}

  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    update({});
  }

  /// Counting sort of the boxes by the cell of their lower corner.
  void update(std::span<const BoxId> /*changed*/) override {
    chooseGrid();
    const std::size_t cells = static_cast<std::size_t>(size_[0]) *
                              static_cast<std::size_t>(size_[1]) *
                              static_cast<std::size_t>(size_[2]);
    starts_.assign(cells + 1, 0);
    cellOf_.resize(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      cellOf_[i] = static_cast<std::uint32_t>(indexOf(cellAt(boxes_[i])));
      ++starts_[cellOf_[i] + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) starts_[c + 1] += starts_[c];
    sorted_.resize(boxes_.size());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      sorted_[next[cellOf_[i]]++] = {boxes_[i], static_cast<std::uint32_t>(i)};
  }

  /// Boxes that overlap lie in the same cell or the next; half of the next are enough.
  void findPairs(std::vector<BoxPair>& pairs) override {
    std::array<int, 3> at;
    for (at[2] = 0; at[2] < size_[2]; ++at[2])
      for (at[1] = 0; at[1] < size_[1]; ++at[1])
        for (at[0] = 0; at[0] < size_[0]; ++at[0]) pairsOfCell(at, pairs);
  }

 private:
  using Cell = std::array<int, 3>;
  struct Entry {
    Box box;
    std::uint32_t slot;
  };

  void chooseGrid() {
    double longest = 0;
    Box all = Box::absent();
    for (const Box& box : boxes_) {
      longest = std::max(longest, longestSide(box));
      for (int axis = 0; axis < 3; ++axis) {
        all.min[axis] = std::min(all.min[axis], box.min[axis]);
        all.max[axis] = std::max(all.max[axis], box.min[axis]);
      }
    }
    edge_ = longest * (1 + 1e-12);
    low_ = all.min;
    for (;; edge_ *= 1.25) {  // no more than a few cells per box
      double cells = 1;
      for (int axis = 0; axis < 3; ++axis) {
        size_[axis] =
            axis < dimensions_
                ? static_cast<int>(std::min((all.max[axis] - low_[axis]) / edge_, 1e6)) + 1
                : 1;
        cells *= size_[axis];
      }
      if (cells <= 4 * static_cast<double>(boxes_.size()) + 64) return;
    }
  }
  [[nodiscard]] Cell cellAt(const Box& box) const {
    Cell cell{};
    for (int axis = 0; axis < dimensions_; ++axis)
      cell[axis] = static_cast<int>((box.min[axis] - low_[axis]) / edge_);
    return cell;
  }
  [[nodiscard]] std::size_t indexOf(const Cell& cell) const {
    return static_cast<std::size_t>(
        (cell[2] * static_cast<std::int64_t>(size_[1]) + cell[1]) * size_[0] + cell[0]);
  }

  void pairsOfCell(const Cell& at, std::vector<BoxPair>& pairs) const {
    const std::size_t own = indexOf(at);
    if (starts_[own] == starts_[own + 1]) return;
    for (std::uint32_t i = starts_[own]; i < starts_[own + 1]; ++i)
      test(sorted_[i], i + 1, starts_[own + 1], pairs);
    for (int shift = 14; shift < 27; ++shift) {
      const Cell to = {at[0] + shift % 3 - 1, at[1] + shift / 3 % 3 - 1, at[2] + shift / 9 - 1};
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) inside &= to[axis] >= 0 && to[axis] < size_[axis];
      if (!inside) continue;
      const std::size_t other = indexOf(to);
      for (std::uint32_t i = starts_[own]; i < starts_[own + 1]; ++i)
        test(sorted_[i], starts_[other], starts_[other + 1], pairs);
    }
  }
  void test(const Entry& entry, std::uint32_t begin, std::uint32_t end,
            std::vector<BoxPair>& pairs) const {
    for (std::uint32_t j = begin; j < end; ++j)
      if (overlaps(entry.box, sorted_[j].box))
        pairs.push_back(orderedPair(BoxId(entry.slot), BoxId(sorted_[j].slot)));
  }

  int dimensions_;
  std::span<const Box> boxes_;
  double edge_ = 1;
  std::array<double, 3> low_{};
  Cell size_{};
  std::vector<std::uint32_t> starts_, cellOf_;
  std::vector<Entry> sorted_;
};

}  // namespace

std::unique_ptr<Rival> makeCells(int dimensions) { return std::make_unique<Cells>(dimensions); }

}  // namespace yadefrag
