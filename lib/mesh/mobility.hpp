#pragma once

#include "mesh/model.hpp"

namespace yadefrag {

/// (1/kg) Acceleration per force on a node, by direction; 0 in a held direction (infinite mass).
/// `drag` is αΔt/2 of the mass-proportional damping, which also acts on the new velocity.
inline Vec2 mobility(const Nodes& nodes, NodeId node, double drag) {
  const double free = 1 / (nodes.mass[node.value] * (1 + drag));
  const std::uint8_t held = nodes.held[node.value];
  return {(held & kHeldX) != 0 ? 0 : free, (held & kHeldY) != 0 ? 0 : free};
}

}  // namespace yadefrag
