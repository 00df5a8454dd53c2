#include "benchmark/rivals/code_tree.hpp"

#include <algorithm>
#include <bit>

#include "core/parallel.hpp"
#include "curve/position_code.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {
namespace {

using Code = PositionCode<3>;

Box enclosing(const Box& a, const Box& b) {
  Box both;
  for (int axis = 0; axis < 3; ++axis) {
    both.min[axis] = std::min(a.min[axis], b.min[axis]);
    both.max[axis] = std::max(a.max[axis], b.max[axis]);
  }
  return both;
}

/// Position codes of the boxes' centres, in cubes of 2⁻²¹ of the longest side of all boxes
/// together.
std::vector<CodedSlot> codesOf(std::span<const Box> boxes,
                               const std::vector<std::uint32_t>& slots) {
  Box all = Box::absent();
  const auto middle = [](const Box& box, int axis) {
    return box.min[axis] + .5 * (box.max[axis] - box.min[axis]);
  };
  for (const std::uint32_t slot : slots)
    for (int axis = 0; axis < 3; ++axis) {
      all.min[axis] = std::min(all.min[axis], middle(boxes[slot], axis));
      all.max[axis] = std::max(all.max[axis], middle(boxes[slot], axis));
    }
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, all.max[axis] - all.min[axis]);
  const double scale = longest > 0 ? Code::kMask / longest : 0;
  std::vector<CodedSlot> codes;
  codes.reserve(slots.size());
  for (const std::uint32_t slot : slots) {
    Code::Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = (middle(boxes[slot], axis) - all.min[axis]) * scale;
      // `at` is NaN if the scale is infinite: any code is then valid.
      cell[axis] = at >= 0 && at <= Code::kMask ? static_cast<std::uint32_t>(at) : 0;
    }
    codes.push_back({Code::encode(cell), slot});
  }
  return codes;
}

}  // namespace

void CodeTree::sortAlongCurve(std::span<const Box> boxes, const std::vector<std::uint32_t>& slots) {
  std::vector<CodedSlot> list = codesOf(boxes, slots);
  sortByCode(list);
  codes_.resize(list.size());
  slots_.resize(list.size());
  boxes_.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    codes_[i] = list[i].code;
    slots_[i] = list[i].slot;
    boxes_[i] = boxes[list[i].slot];
  }
}

/// Number of leading bits that the codes i and j have in common; equal codes are distinguished by
/// their indices. −1 for an index out of range.
int CodeTree::common(std::int64_t i, std::int64_t j) const {
  if (j < 0 || j >= static_cast<std::int64_t>(codes_.size())) return -1;
  const std::uint64_t differing =
      codes_[static_cast<std::size_t>(i)] ^ codes_[static_cast<std::size_t>(j)];
  if (differing) return std::countl_zero(differing);
  return 64 + std::countl_zero(static_cast<std::uint64_t>(i) ^ static_cast<std::uint64_t>(j));
}

/// Node i covers a run of leaves that begins or ends at leaf i (§3 of Karras). Computes its
/// direction, its other end, and the place at which the highest bit of its codes changes.
void CodeTree::makeNode(std::int64_t i) {
  const int direction = common(i, i + 1) > common(i, i - 1) ? 1 : -1;
  const int least = common(i, i - direction);
  std::int64_t most = 2;
  while (common(i, i + most * direction) > least) most *= 2;
  std::int64_t length = 0;
  for (std::int64_t step = most / 2; step > 0; step /= 2)
    if (common(i, i + (length + step) * direction) > least) length += step;
  const std::int64_t end = i + length * direction;
  const int own = common(i, end);
  std::int64_t split = 0;
  for (std::int64_t step = length; step > 1;) {
    step = (step + 1) / 2;
    if (common(i, i + (split + step) * direction) > own) split += step;
  }
  const std::int64_t at = i + split * direction + std::min(direction, 0);
  const std::int64_t first = std::min(i, end), last = std::max(i, end);
  Node& node = nodes_[static_cast<std::size_t>(i)];
  const auto child = [](std::int64_t place, bool isLeaf) {
    return static_cast<std::uint32_t>(place) | (isLeaf ? kLeafFlag : 0);
  };
  node.left = child(at, at == first);
  node.right = child(at + 1, at + 1 == last);
  node.last = static_cast<std::uint32_t>(last);
}

/// Bounding boxes of a subtree, bottom-up. The depth is limited by the bits of codes and indices to
/// 96.
const Box& CodeTree::fit(std::uint32_t child) {
  if (child & kLeafFlag) return boxes_[child & ~kLeafFlag];
  Node& node = nodes_[child];
  const Box& left = fit(node.left);
  node.box = enclosing(left, fit(node.right));
  return node.box;
}

void CodeTree::build(std::span<const Box> boxes, const std::vector<std::uint32_t>& slots,
                     int threads) {
  sortAlongCurve(boxes, slots);
  nodes_.resize(slots_.size() > 1 ? slots_.size() - 1 : 0);
  forEachPart(nodes_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) makeNode(static_cast<std::int64_t>(i));
  });
  if (!nodes_.empty()) fit(0);
}

}  // namespace yadefrag
