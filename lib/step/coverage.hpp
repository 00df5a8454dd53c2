#pragma once
// Bodies that touch: outlines moved onto them.

#include <vector>

#include "mesh/model.hpp"
#include "outline/snap.hpp"

namespace yadefrag {

class World;

/// Bodies with elements.
[[nodiscard]] std::vector<ComponentId> bodiesOf(const Model& model);

/// An outline moved onto the present boundaries of all bodies.
[[nodiscard]] Snapped snapOnBodies(const World& world, const Polygon& polygon,
                                   const SnapRule& rule);

}  // namespace yadefrag
