#pragma once
// Two bodies that hang together along sides that they have in common: cracks that are there from
// the start and that hold from the start, as the cohesive law says. Each keeps its own nodes.

#include <array>
#include <vector>

#include "fracture/crack_edges.hpp"

namespace yadefrag {

/// Pairs of boundary sides, the first of body `a` and the second of `b`, whose ends are at the same
/// places, to kBondGap of a side; sides that are bonded already, and faces of cracks, do not count.
/// Throws InputError, and says what would be right, if there are none, or if sides of the two lie
/// along each other elsewhere (kBondMeant) without such ends.
[[nodiscard]] std::vector<std::array<Side, 2>> matchingSides(const Model& model,
                                                             const CrackEdges& edges, ComponentId a,
                                                             ComponentId b);

/// Throws InputError unless a bond can have this strength (Pa) and energy (J/m²).
void checkBond(double strength, double energy);

}  // namespace yadefrag
