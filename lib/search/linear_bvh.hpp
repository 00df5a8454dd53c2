#pragma once
// Search in a tree over position codes that is rebuilt for every update (LBVH, Karras 2012).

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "search/box_count.hpp"
#include "search/code_tree.hpp"
#include "search/contact_search.hpp"
#include "search/wide_boxes.hpp"

namespace yadefrag {

template <class Count>
class LinearBvh final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    boxes_ = boxes;
    finite_.clear();
    wide_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].isAbsent()) continue;
      if (isFinite(boxes[i]))
        finite_.push_back(static_cast<std::uint32_t>(i));
      else
        wide_.add(i);
    }
    tree_.build(boxes, finite_, threads_);
  }

  void findPairs(std::vector<BoxPair>& pairs) override {
    std::vector<PartList<BoxPair>> partPairs(static_cast<std::size_t>(std::max(threads_, 1)));
    std::vector<Count> counts(partPairs.size());
    const auto slots = tree_.slots();
    const int parts =
        forEachPart(slots.size(), threads_, [&](std::size_t begin, std::size_t end, int part) {
          std::vector<BoxPair>& out = partPairs[part];
          for (std::size_t i = begin; i < end && !isFull(out); ++i) {
            descend(tree_.boxes()[i], i + 1, counts[part], [&](std::uint32_t other) {
              out.push_back(orderedPair(BoxId(slots[i]), BoxId(other)));
            });
            wide_.pairsWith(boxes_, tree_.boxes()[i], slots[i], out, counts[part]);
          }
        });
    join({partPairs.data(), static_cast<std::size_t>(parts)}, pairs);
    for (int part = 0; part < parts; ++part) count_.merge(counts[part]);
    wide_.pairsAmong(boxes_, pairs, count_, mostPairs_);
  }

  void findOverlaps(const Box& box, std::vector<BoxId>& found) const override {
    Count uncounted;
    descend(box, 0, uncounted, [&](std::uint32_t other) { found.push_back(BoxId(other)); });
    wide_.overlapsWith(boxes_, box, found, uncounted);
  }

  void relocate(std::span<const Box> boxes) override { boxes_ = boxes; }
  void clear() override { tree_ = {}; }
  [[nodiscard]] Comparisons comparisons() const override { return count_.total(); }
  void addTo(Footprint& footprint) const override {
    footprint.add(Use::kSearch, finite_);
    tree_.addTo(footprint);
    wide_.addTo(footprint);
  }

 private:
  static bool isFinite(const Box& box) {
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(box.max[axis] - box.min[axis])) return false;
    return true;
  }

  /// Visits the slots whose boxes overlap `box`, from the leaf `first` on.
  template <class Visit>
  void descend(const Box& box, std::size_t first, Count& count, Visit visit) const {
    std::array<std::uint32_t, 128> waiting;  // at most one node of each depth
    std::size_t size = 0;
    const auto enter = [&](std::uint32_t child) {
      const bool isLeaf = child & CodeTree::kLeafFlag;
      const std::uint32_t place = child & ~CodeTree::kLeafFlag;
      count.range(7);
      if ((isLeaf ? place : tree_.nodes()[place].last) < first) return;
      if (!overlaps(box, isLeaf ? tree_.boxes()[place] : tree_.nodes()[place].box)) return;
      if (isLeaf)
        visit(tree_.slots()[place]);
      else
        waiting[size++] = place;
    };
    if (!tree_.slots().empty()) enter(tree_.nodes().empty() ? CodeTree::kLeafFlag : 0);
    while (size > 0) {
      const CodeTree::Node& node = tree_.nodes()[waiting[--size]];
      enter(node.left);
      enter(node.right);
    }
  }

  std::span<const Box> boxes_;
  std::vector<std::uint32_t> finite_;
  CodeTree tree_;
  WideBoxes wide_;
  Count count_;
};

}  // namespace yadefrag
