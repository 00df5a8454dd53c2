#include "figure14/point_hierarchy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/tolerances/search.hpp"

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

}  // namespace

void SurfaceTree::build(std::span<const std::uint32_t> loopStart, std::size_t entries) {
  nodes_.clear();
  if (entries == 0) return;
  std::vector<std::uint32_t> bounds = {0};
  for (const std::uint32_t start : loopStart)
    if (start > bounds.back() && start < entries) bounds.push_back(start);
  bounds.push_back(static_cast<std::uint32_t>(entries));
  buildLoops(bounds);
}

void SurfaceTree::buildLoops(std::span<const std::uint32_t> bounds) {
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

void SurfaceTree::buildRun(std::uint32_t begin, std::uint32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({{}, 0, begin});
  if (end - begin == 1) return;
  const std::uint32_t middle = begin + (end - begin) / 2;
  buildRun(begin, middle);
  nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
  buildRun(middle, end);
}

std::size_t SurfaceTree::refit(std::span<const Rectangle> masters) {
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

template <class Count>
void PointHierarchySearch<Count>::find(std::span<const Rectangle> masters, double halo,
                                       Csr<EntryId>& candidates) {
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

template <class Count>
void PointHierarchySearch<Count>::within(std::uint32_t group) {
  const SurfaceTree::Node& node = tree_.nodes()[group];
  if (node.isLeaf()) {
    test(node.entry, node.entry);
    return;
  }
  within(group + 1);
  within(node.second);
  between(group + 1, node.second);
}

template <class Count>
void PointHierarchySearch<Count>::between(std::uint32_t a, std::uint32_t b) {
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

template <class Count>
void PointHierarchySearch<Count>::test(std::uint32_t master, std::uint32_t slave) {
  count_.test(4);
  if (contains(enlarged(masters_[master], halo_), points_[slave]))
    found_.push_back({master, slave});
}

template class PointHierarchySearch<CountNothing>;
template class PointHierarchySearch<CountAll>;

}  // namespace yadefrag
