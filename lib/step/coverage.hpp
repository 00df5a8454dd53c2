#pragma once
// Bodies that touch: outlines moved onto them, and bonds of all neighbours.

#include <vector>

#include "fracture/bonds.hpp"
#include "mesh/snap.hpp"

namespace yadefrag {

class World;

/// Bodies with elements.
[[nodiscard]] std::vector<ComponentId> bodiesOf(const Model& model);

/// An outline moved onto the present boundaries of all bodies.
[[nodiscard]] Snapped snapOnBodies(const World& world, const Polygon& polygon,
                                   const SnapRule& rule);

/// Bonds all bodies along all present common sides, as World::bond. Sides up to `reach` (m) apart
/// that do not match are counted in the result, and not bonded.
CommonSides bondAll(World& world, double reach, double strength, double energy);

}  // namespace yadefrag
