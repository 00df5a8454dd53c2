#pragma once
// Bonds of two bodies along common sides: cracks that exist from the start and transmit traction
// from the start, by the cohesive law. Each body keeps its own nodes.

#include <array>
#include <vector>

#include "fracture/crack_edges.hpp"

namespace yadefrag {

/// Pairs of boundary sides, the first of body `a` and the second of `b`, whose ends coincide, to
/// kBondGap of a side. Sides that are bonded already and faces of cracks are excluded. Throws
/// InputError, with the remedy, if there are none, or if sides of the two coincide elsewhere
/// (kProbableBond) with different ends.
[[nodiscard]] std::vector<std::array<Side, 2>> matchingSides(const Model& model,
                                                             const CrackEdges& edges, ComponentId a,
                                                             ComponentId b);

/// Throws InputError unless strength (Pa) and energy (J/m²) are valid for a bond.
void checkBond(double strength, double energy);

}  // namespace yadefrag
