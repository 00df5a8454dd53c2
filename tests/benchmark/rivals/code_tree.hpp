#pragma once
// A binary tree over sorted position codes, after T. Karras, Maximizing Parallelism in the
// Construction of BVHs, Octrees, and k-d Trees, High Performance Graphics 2012.

#include <cstdint>
#include <span>
#include <vector>

#include "core/box.hpp"

namespace yadefrag {

class CodeTree {
 public:
  /// An inner node. A child number below `kLeafFlag` is an inner node; any other number is a leaf,
  /// of number `child - kLeafFlag`.
  struct Node {
    Box box;
    std::uint32_t left, right;
    std::uint32_t last;  ///< the last leaf below it
  };
  static constexpr std::uint32_t kLeafFlag = std::uint32_t{1} << 31;

  /// Builds the tree over finite boxes; node 0 is the root. With fewer than two boxes there is no
  /// node.
  void build(std::span<const Box> boxes, const std::vector<std::uint32_t>& slots, int threads);

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  /// Slots and boxes of the leaves, in curve order.
  [[nodiscard]] std::span<const std::uint32_t> slots() const { return slots_; }
  [[nodiscard]] std::span<const Box> boxes() const { return boxes_; }

 private:
  void sortAlongCurve(std::span<const Box> boxes, const std::vector<std::uint32_t>& slots);
  [[nodiscard]] int common(std::int64_t i, std::int64_t j) const;
  void makeNode(std::int64_t i);
  const Box& fit(std::uint32_t child);

  std::vector<Node> nodes_;
  std::vector<std::uint64_t> codes_;
  std::vector<std::uint32_t> slots_;
  std::vector<Box> boxes_;
};

}  // namespace yadefrag
