#include "search/hierarchy_search.hpp"

#include <algorithm>

#include "core/tolerances/search.hpp"

namespace yadefrag {
namespace {

void enclose(Box& all, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    all.min[axis] = std::min(all.min[axis], box.min[axis]);
    all.max[axis] = std::max(all.max[axis], box.max[axis]);
  }
}

int longestAxis(const Box& box) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (box.max[axis] - box.min[axis] > box.max[longest] - box.min[longest]) longest = axis;
  return longest;
}

}  // namespace

void Hierarchy::build(std::span<const Box> boxes, std::vector<std::uint32_t> slots) {
  order_ = std::move(slots);
  nodes_.clear();
  if (!order_.empty()) buildRange(boxes, 0, static_cast<std::uint32_t>(order_.size()));
  refit(boxes);
  loosenessAtStart_ = looseness();
}

void Hierarchy::buildRange(std::span<const Box> boxes, std::uint32_t begin, std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({Box::absent(), begin, end, 0});
  if (end - begin > tolerance::kHierarchyLeaf) {
    Box all = Box::absent();
    for (std::uint32_t i = begin; i < end; ++i) enclose(all, boxes[order_[i]]);
    const int axis = longestAxis(all);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = boxes[a].min[axis] + boxes[a].max[axis];
                       const double y = boxes[b].min[axis] + boxes[b].max[axis];
                       return x != y ? x < y : a < b;
                     });
    buildRange(boxes, begin, middle);
    buildRange(boxes, middle, end);
  }
  nodes_[at].skip = static_cast<std::uint32_t>(nodes_.size());
}

bool Hierarchy::refit(std::span<const Box> boxes) {
  // Children come after their parent: in reverse order every child is fitted before its parent
  // needs it.
  for (std::uint32_t at = static_cast<std::uint32_t>(nodes_.size()); at-- > 0;) fit(boxes, at);
  return looseness() <= tolerance::kHierarchyDecay * loosenessAtStart_;
}

void Hierarchy::fit(std::span<const Box> boxes, std::uint32_t at) {
  Node& node = nodes_[at];
  node.box = Box::absent();
  if (node.isLeaf(at)) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) enclose(node.box, boxes[order_[i]]);
    return;
  }
  const Node& first = nodes_[at + 1];
  enclose(node.box, first.box);
  enclose(node.box, nodes_[first.skip].box);
}

double Hierarchy::looseness() const {
  double sum = 0;
  for (const Node& node : nodes_)
    for (int axis = 0; axis < 3; ++axis) sum += node.box.max[axis] - node.box.min[axis];
  return sum;
}

}  // namespace yadefrag
