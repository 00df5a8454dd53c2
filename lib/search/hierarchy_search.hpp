#pragma once
// Search in a tree of boxes (HO, the paper's [12]), the second method that the paper compares with.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/comparisons.hpp"
#include "core/parallel.hpp"
#include "search/contact_search.hpp"
#include "search/search_plan.hpp"
#include "search/wide_boxes.hpp"

namespace yadefrag {

/// Nodes in depth-first order. A node's first child is the next node; its leaves are a run of
/// `order`.
class Hierarchy {
 public:
  struct Node {
    Box box;
    std::uint32_t begin, end;  // its run of `order`
    std::uint32_t skip;        // the node after its subtree
    [[nodiscard]] bool isLeaf(std::uint32_t at) const { return skip == at + 1; }
  };

  /// Builds the tree over the given slots by bisection along the longest side.
  void build(std::span<const Box> boxes, std::vector<std::uint32_t> slots);

  /// Adapts the nodes to boxes that have moved. Returns false if the nodes have become so large
  /// that the tree should be rebuilt.
  bool refit(std::span<const Box> boxes);

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

 private:
  void buildRange(std::span<const Box> boxes, std::uint32_t begin, std::uint32_t end);
  void fit(std::span<const Box> boxes, std::uint32_t at);
  [[nodiscard]] double looseness() const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  double loosenessAtStart_ = 0;
};

class HierarchySearch final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    boxes_ = boxes;
    std::vector<std::uint32_t> slots;
    wide_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].isAbsent()) continue;
      if (isFinite(boxes[i]))
        slots.push_back(static_cast<std::uint32_t>(i));
      else
        wide_.add(i);
    }
    if (slots != slots_ || !tree_.refit(boxes)) {
      slots_ = slots;
      tree_.build(boxes, std::move(slots));
    }
  }

  void findPairs(std::vector<BoxPair>& pairs) override {
    const std::span<const std::uint32_t> order = tree_.order();
    std::vector<PartList<BoxPair>> partPairs(static_cast<std::size_t>(std::max(threads_, 1)));
    std::vector<Count> counts = countsOf(partPairs.size());
    const int parts =
        forEachPart(order.size(), threads_, [&](std::size_t begin, std::size_t end, int part) {
          for (std::size_t i = begin; i < end && !isFull(partPairs[part]); ++i) {
            const Box& box = boxes_[order[i]];
            descend(box, i + 1, counts[part], [&](std::uint32_t other) {
              partPairs[part].push_back(orderedPair(BoxId(order[i]), BoxId(other)));
            });
            wide_.pairsWith(boxes_, box, order[i], partPairs[part], counts[part]);
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
  void clear() override {
    slots_.clear();
    tree_ = {};
  }

 private:
  static bool isFinite(const Box& box) {
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(box.max[axis] - box.min[axis])) return false;
    return true;
  }

  /// Visits the slots whose boxes overlap `box`, from the `first` one of the tree's order on.
  template <class Visit>
  void descend(const Box& box, std::size_t first, Count& count, Visit visit) const {
    const std::span<const Hierarchy::Node> nodes = tree_.nodes();
    for (std::uint32_t at = 0; at < nodes.size();) {
      const Hierarchy::Node& node = nodes[at];
      count.range(7);
      if (node.end <= first || !overlaps(box, node.box)) {
        at = node.skip;
        continue;
      }
      if (node.isLeaf(at))
        for (std::size_t i = std::max<std::size_t>(node.begin, first); i < node.end; ++i) {
          count.test(6);
          if (overlaps(box, boxes_[tree_.order()[i]])) visit(tree_.order()[i]);
        }
      ++at;
    }
  }

  std::span<const Box> boxes_;
  std::vector<std::uint32_t> slots_;  // slots in the tree, ascending
  Hierarchy tree_;
  WideBoxes wide_;
};

}  // namespace yadefrag
