#pragma once
// Bonds of two bodies along common sides: cracks that exist from the start and transmit traction
// from the start, by the cohesive law. Each body keeps its own nodes.

#include <array>
#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"

namespace yadefrag {

/// Boundary sides of several bodies that lie on each other.
struct CommonSides {
  std::vector<std::array<Side, 2>> pairs;  ///< whose ends coincide, to kBondGap of a side
  /// (count) Sides along another one with other ends, or farther from it; a pair of bodies, and a
  /// place (m), of which this is true.
  std::size_t unmatched = 0;
  std::array<ComponentId, 2> bodies;
  Vec2 place;
};

/// Sides that are bonded already and faces of cracks are excluded. `reach` (m): sides along each
/// other up to this distance are compared; if it is 0, up to kProbableBond of a side.
[[nodiscard]] CommonSides commonSides(const Model& model, const CrackEdges& edges,
                                      std::span<const ComponentId> bodies, double reach = 0);

/// Throws InputError, with the remedy, if two bodies have no common sides, or any that do not
/// match.
void requireMatch(const CommonSides& found, ComponentId a, ComponentId b);

/// Throws InputError unless strength (Pa) and energy (J/m²) are valid for a bond.
void checkBond(double strength, double energy);

}  // namespace yadefrag
