#pragma once
// Fragments that nothing holds any more, no cohesive crack either.

#include <cstdint>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

/// (m²) Their areas.
inline std::vector<double> wholePieces(const World& world) {
  const CrackEdges& edges = world.fracture.edges;
  const std::vector<double>& areas = world.model.triangles.area;
  DisjointSets pieces(areas.size());
  const auto join = [&](EdgeId edge) {
    const auto [a, b] = edges.element[edge.value];
    pieces.join(a.value, b.value);
  };
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.cracked[i] == 0) join(EdgeId(i));
  for (const EdgeId edge : world.fracture.cohesion.edge) join(edge);
  std::vector<double> sums(areas.size());
  for (std::uint32_t e = 0; e < areas.size(); ++e) sums[pieces.find(e)] += areas[e];
  std::erase(sums, 0);
  return sums;
}

}  // namespace yadefrag::test
