#pragma once
// Groups of segments along the surfaces, and groups of groups (HO, the paper's [12]). The tree's
// structure is fixed; its boxes follow the motion.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "figure14/point_search.hpp"

namespace yadefrag {

/// A binary tree over entries in the order of their surfaces: below a loop, halves of the loop;
/// above, loops in the order of their numbers. Nodes are in depth-first order: the first child
/// follows its parent. A leaf is one entry.
class SurfaceTree {
 public:
  struct Node {
    Rectangle box;         // bounding box of the masters, without halo
    std::uint32_t second;  // the second child; 0 for a leaf
    std::uint32_t entry;   // entry of a leaf
    [[nodiscard]] bool isLeaf() const { return second == 0; }
  };

  void build(std::span<const std::uint32_t> loopStart, std::size_t entries);

  /// Fits all boxes to the present masters. Returns the number of inner nodes.
  std::size_t refit(std::span<const Rectangle> masters);

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

 private:
  void buildLoops(std::span<const std::uint32_t> bounds);
  void buildRun(std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
};

template <class Count>
class PointHierarchySearch final : public PointSearch {
 public:
  explicit PointHierarchySearch(PointSearchPlan plan) : loopStart_(std::move(plan.loopStart)) {}

  void update(std::span<const Vec2> points) override {
    if (points.size() != points_.size()) tree_.build(loopStart_, points.size());
    points_ = points;
  }

  void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) override;

  [[nodiscard]] Comparisons comparisons() const override { return count_.total(); }

 private:
  struct Candidate {
    std::uint32_t master, slave;
  };

  /// Tests a group against itself, and two groups against each other. Their contents can be
  /// candidates only if the distance of their boxes is within the halo (§6).
  void within(std::uint32_t group);
  void between(std::uint32_t a, std::uint32_t b);
  void test(std::uint32_t master, std::uint32_t slave);

  [[nodiscard]] bool areNear(const Rectangle& a, const Rectangle& b) const {
    return bool((a.low.x - reach_ <= b.high.x) & (b.low.x - reach_ <= a.high.x) &
                (a.low.y - reach_ <= b.high.y) & (b.low.y - reach_ <= a.high.y));
  }

  std::vector<std::uint32_t> loopStart_;
  SurfaceTree tree_;
  std::span<const Vec2> points_;
  std::span<const Rectangle> masters_;
  double halo_ = 0, reach_ = 0;
  std::vector<Candidate> found_;
  Count count_;
};

}  // namespace yadefrag
