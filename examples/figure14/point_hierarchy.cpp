// Groups of segments along the surfaces, and groups of groups (HO, the paper's [12]). The tree's
// structure is fixed; its boxes follow the motion.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/tolerances/search.hpp"
#include "figure14/point_search.hpp"

namespace yadefrag {
namespace {

Rectangle around(const Rectangle& a, const Rectangle& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

double longestSide(const Rectangle& r) { return std::max(r.high.x - r.low.x, r.high.y - r.low.y); }

double farthest(const Rectangle& r) {
  return std::max(std::max(std::abs(r.low.x), std::abs(r.high.x)),
                  std::max(std::abs(r.low.y), std::abs(r.high.y)));
}

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

  void build(std::span<const std::uint32_t> loopStart, std::size_t entries) {
    nodes_.clear();
    if (entries == 0) return;
    std::vector<std::uint32_t> bounds = {0};
    for (const std::uint32_t start : loopStart)
      if (start > bounds.back() && start < entries) bounds.push_back(start);
    bounds.push_back(static_cast<std::uint32_t>(entries));
    buildLoops(bounds);
  }

  /// Fits all boxes to the present masters. Returns the number of inner nodes.
  std::size_t refit(std::span<const Rectangle> masters) {
    std::size_t inner = 0;
    for (std::size_t at = nodes_.size(); at-- > 0;) {  // children before their parent
      Node& node = nodes_[at];
      if (node.isLeaf()) {
        node.box = masters[node.entry];
      } else {
        node.box = around(nodes_[at + 1].box, nodes_[node.second].box);
        ++inner;
      }
    }
    return inner;
  }

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

 private:
  void buildLoops(std::span<const std::uint32_t> bounds) {
    const std::size_t loops = bounds.size() - 1;
    if (loops == 1) {
      buildRun(bounds[0], bounds[1]);
      return;
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back({});
    buildLoops(bounds.first(loops / 2 + 1));
    nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
    buildLoops(bounds.subspan(loops / 2));
  }

  void buildRun(std::uint32_t begin, std::uint32_t end) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, 0, begin});
    if (end - begin == 1) return;
    const std::uint32_t middle = begin + (end - begin) / 2;
    buildRun(begin, middle);
    nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
    buildRun(middle, end);
  }

  std::vector<Node> nodes_;
};

class PointHierarchySearch final : public PointSearch {
 public:
  explicit PointHierarchySearch(PointSearchPlan plan) : loopStart_(std::move(plan.loopStart)) {}

  void update(std::span<const Vec2> points) override {
    if (points.size() != points_.size()) tree_.build(loopStart_, points.size());
    points_ = points;
  }

  void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) override {
    assert(masters.size() == points_.size());
    masters_ = masters;
    halo_ = halo;
    found_.clear();
    count_.resort(4 * tree_.refit(masters));
    if (!masters.empty()) {
      // `contains` rounds when it adds the halo; that must not exclude a group.
      const Rectangle& all = tree_.nodes()[0].box;
      reach_ = halo + (farthest(all) + halo) * tolerance::kExtentRounding;
      within(0);
    }
    fillRows(
        candidates, masters.size(), found_.size(), [&](std::size_t i) { return found_[i].master; },
        [&](std::size_t i) { return EntryId(found_[i].slave); });
  }

 private:
  struct Candidate {
    std::uint32_t master, slave;
  };

  /// Tests a group against itself, and two groups against each other. Their contents can be
  /// candidates only if the distance of their boxes is within the halo (§6).
  void within(std::uint32_t group) {
    const SurfaceTree::Node& node = tree_.nodes()[group];
    if (node.isLeaf()) {
      test(node.entry, node.entry);
      return;
    }
    within(group + 1);
    within(node.second);
    between(group + 1, node.second);
  }

  void between(std::uint32_t a, std::uint32_t b) {
    const SurfaceTree::Node& first = tree_.nodes()[a];
    const SurfaceTree::Node& second = tree_.nodes()[b];
    count_.range(4);
    if (!areNear(first.box, second.box)) return;
    if (first.isLeaf() && second.isLeaf()) {
      test(first.entry, second.entry);
      test(second.entry, first.entry);
    } else if (second.isLeaf() ||
               (!first.isLeaf() && longestSide(first.box) >= longestSide(second.box))) {
      between(a + 1, b);
      between(first.second, b);
    } else {
      between(a, b + 1);
      between(a, second.second);
    }
  }

  void test(std::uint32_t master, std::uint32_t slave) {
    count_.test(4);
    if (contains(enlarged(masters_[master], halo_), points_[slave]))
      found_.push_back({master, slave});
  }

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
};

}  // namespace

std::unique_ptr<PointSearch> makePointHierarchy(PointSearchPlan plan) {
  return std::make_unique<PointHierarchySearch>(std::move(plan));
}

}  // namespace yadefrag
