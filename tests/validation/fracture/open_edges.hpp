#pragma once
// Cracks that hold nothing any more, as lines of the stress-free shape.

#include <algorithm>
#include <vector>

#include "step/world.hpp"

namespace yadefrag::test {

struct OpenEdge {
  Vec2 first, last;  // m
  [[nodiscard]] Vec2 middle() const { return .5 * (first + last); }
};

inline std::vector<OpenEdge> openEdges(const World& world) {
  const CrackEdges& edges = world.fracture.edges;
  const std::vector<EdgeId>& holding = world.fracture.cohesion.edge;
  std::vector<OpenEdge> open;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges.cracked[i] == 0 || std::ranges::find(holding, EdgeId(i)) != holding.end()) continue;
    const Side side = edges.side(EdgeId(i), 0);
    open.push_back({world.model.nodes.reference[firstNode(world.model, side).value],
                    world.model.nodes.reference[lastNode(world.model, side).value]});
  }
  return open;
}

}  // namespace yadefrag::test
