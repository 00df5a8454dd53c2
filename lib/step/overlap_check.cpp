#include "step/overlap_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/tolerances.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

using Corners = std::array<Vec2, 3>;

Box boxAround(const Vec2* points, std::size_t count) {
  Box box{{points->x, points->y, 0}, {points->x, points->y, 0}};
  for (std::size_t i = 1; i < count; ++i) {
    box.min = {std::min(box.min[0], points[i].x), std::min(box.min[1], points[i].y), 0};
    box.max = {std::max(box.max[0], points[i].x), std::max(box.max[1], points[i].y), 0};
  }
  return box;
}

/// The part of a segment, from 0 to 1, that is deeper than `margin` (m) in a triangle.
struct Part {
  double begin = 0, end = 1;
  [[nodiscard]] bool isEmpty() const { return !(begin < end); }
};

Part partInside(Vec2 from, Vec2 to, const Corners& triangle, double margin) {
  Part part;
  for (int i = 0; i < 3; ++i) {
    const Vec2 corner = triangle[i];
    const Vec2 along = triangle[(i + 1) % 3] - corner;
    const double length = norm(along);
    const double first = cross(along, from - corner) - margin * length;
    const double last = cross(along, to - corner) - margin * length;
    if (first <= 0 && last <= 0) return {1, 0};
    const double at = first / (first - last);
    if (first < 0) part.begin = std::max(part.begin, at);
    if (last < 0) part.end = std::min(part.end, at);
  }
  return part;
}

/// (m) What contact counts as touching, for the shortest piece there may be on these edges.
double margin(const Corners& triangle, Vec2 from, Vec2 to) {
  double shortest = norm(to - from), farthest = 0;
  for (int i = 0; i < 3; ++i) {
    shortest = std::min(shortest, norm(triangle[(i + 1) % 3] - triangle[i]));
    farthest = std::max({farthest, std::abs(triangle[i].x), std::abs(triangle[i].y)});
  }
  return std::max(.5 * tolerance::kTouching * shortest, tolerance::kTouchRounding * farthest);
}

class OverlapSearch {
 public:
  OverlapSearch(const Model& model, const ContactSurfaces& surfaces)
      : model_(model), surfaces_(surfaces) {}

  std::optional<Overlap> find(ComponentId firstNew) const {
    const std::size_t segments = surfaces_.segments();
    std::vector<Box> boxes;
    for (std::size_t s = 0; s < segments; ++s) {
      const Vec2 ends[] = {at(first(s)), at(last(s))};
      boxes.push_back(boxAround(ends, 2));
    }
    for (std::size_t e = 0; e < model_.triangles.size(); ++e)
      boxes.push_back(boxAround(corners(e).data(), 3));
    const std::unique_ptr<ContactSearch> search = makeSearch(SearchMethod::kLebesgue);
    search->update(boxes);
    std::vector<BoxPair> pairs;
    search->findPairs(pairs);
    for (const BoxPair& pair : pairs) {
      const std::size_t a = std::min(pair.first.value, pair.second.value);
      const std::size_t b = std::max(pair.first.value, pair.second.value);
      if (a >= segments || b < segments) continue;
      const auto overlap = meet(a, b - segments);
      if (overlap && std::max(overlap->a, overlap->b) >= firstNew) return overlap;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] NodeId first(std::size_t segment) const { return surfaces_.segmentNode[segment]; }
  [[nodiscard]] NodeId last(std::size_t segment) const {
    return surfaces_.segmentNode[surfaces_.segmentNext[segment].value];
  }
  [[nodiscard]] Vec2 at(NodeId node) const { return model_.nodes.position[node.value]; }
  [[nodiscard]] Corners corners(std::size_t element) const {
    const auto& nodes = model_.triangles.nodes[element];
    return {at(nodes[0]), at(nodes[1]), at(nodes[2])};
  }

  [[nodiscard]] std::optional<Overlap> meet(std::size_t segment, std::size_t element) const {
    const ComponentId own = model_.nodes.component[first(segment).value];
    const ComponentId other = model_.triangles.component[element];
    if (own == other || model_.triangles.isDropped(element) || allHeld(segment, element))
      return std::nullopt;
    const Corners triangle = corners(element);
    const Vec2 from = at(first(segment)), to = at(last(segment));
    const double touching = margin(triangle, from, to);
    const Part part = partInside(from, to, triangle, touching);
    if (!part.isEmpty())
      return Overlap{own, other, from + (part.begin + part.end) / 2 * (to - from)};
    // Of two bodies with the same outline, no side is inside the other one; what is beside it is.
    const Vec2 beside = .5 * (from + to) - (touching / norm(to - from)) * rightOf(to - from);
    if (partInside(beside, beside, triangle, .5 * touching).isEmpty()) return std::nullopt;
    return Overlap{own, other, beside};
  }

  [[nodiscard]] bool allHeld(std::size_t segment, std::size_t element) const {
    const auto& nodes = model_.triangles.nodes[element];
    std::uint8_t held = kHeldXY;
    for (const NodeId node : {first(segment), last(segment), nodes[0], nodes[1], nodes[2]})
      held &= model_.nodes.held[node.value];
    return held == kHeldXY;
  }

  const Model& model_;
  const ContactSurfaces& surfaces_;
};

}  // namespace

std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   ComponentId firstNew) {
  return OverlapSearch(model, surfaces).find(firstNew);
}

}  // namespace yadefrag
