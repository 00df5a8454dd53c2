#include "step/overlap_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

using Corners = std::array<Vec2, 3>;

Corners cornersOf(const Model& model, std::size_t triangle) {
  const auto& [a, b, c] = model.triangles.nodes[triangle];
  const std::vector<Vec2>& at = model.nodes.position;
  return {at[a.value], at[b.value], at[c.value]};
}

Box boxOf(const Corners& corners) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  return {{left, low, 0}, {right, high, 0}};
}

bool shareNode(const std::array<NodeId, 3>& a, const std::array<NodeId, 3>& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

}  // namespace

double overlapOf(const Corners& a, const Corners& b) {
  double least = INFINITY;
  for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 from = (*own)[k], along = (*own)[(k + 1) % 3] - from;
      double inside = 0;
      for (const Vec2 point : *other) inside = std::max(inside, cross(along, point - from));
      least = std::min(least, inside / norm(along));
    }
  return least;
}

double deepestOverlap(const Model& model, int threads) {
  return deepestOverlap(model, std::vector<std::uint8_t>(model.nodes.size(), 1), threads);
}

double deepestOverlap(const Model& model, std::span<const std::uint8_t> among, int threads) {
  const Triangles& triangles = model.triangles;
  const auto isAmong = [&](std::size_t t) {
    return !triangles.isDropped(t) && std::ranges::any_of(triangles.nodes[t], [&](NodeId node) {
      return among[node.value] != 0;
    });
  };
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    boxes.push_back(isAmong(t) ? boxOf(cornersOf(model, t)) : Box::absent());
  double deepest = 0;
  for (const auto& [first, second] : overlappingPairs(boxes, threads, SearchMethod::kFastest))
    if (!shareNode(triangles.nodes[first.value], triangles.nodes[second.value]))
      deepest = std::max(deepest,
                         overlapOf(cornersOf(model, first.value), cornersOf(model, second.value)));
  return deepest;
}

}  // namespace yadefrag
