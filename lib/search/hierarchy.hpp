#pragma once
// A binary tree of bounding boxes: the data of the hierarchical search (HO, the paper's [12]).

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"

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

}  // namespace yadefrag
