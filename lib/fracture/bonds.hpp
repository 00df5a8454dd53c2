#pragma once
// Bonds of two bodies along common sides: cracks that exist from the start and transmit traction
// from the start, by the cohesive law. Each body keeps its own nodes.

#include <array>
#include <span>
#include <vector>

#include "fracture/crack_edges.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

/// Sides of one triangle only, which are no edge of CrackEdges; ascending.
[[nodiscard]] std::vector<Side> freeSides(const Model& model, const CrackEdges& edges,
                                          ComponentId component);

/// The free sides of several bodies.
struct FreeSides {
  std::vector<Side> sides;
  std::vector<ComponentId> owners;  ///< by side
  FreeSides(const Model& model, const CrackEdges& edges, std::span<const ComponentId> bodies);
};

struct Line {
  Vec2 begin, end;  // m
  [[nodiscard]] double length() const { return norm(end - begin); }
};

/// `places`: m, by node.
[[nodiscard]] std::vector<Line> linesOf(const Model& model, std::span<const Vec2> places,
                                        std::span<const Side> sides);

/// (m) Distance up to which two ends of sides with this length (m) are the same place.
[[nodiscard]] double samePlace(double length, Vec2 a, Vec2 b);

/// Boundary sides have the material on the left: sides of two bodies match if they run in opposite
/// directions.
[[nodiscard]] bool match(const Line& a, const Line& b);

/// (m) `reach`, or kProbableBond of the length if it is 0.
[[nodiscard]] double reachOf(double length, double reach);

/// True if two sides are parallel and run beside each other, up to `reach` (m) apart.
[[nodiscard]] bool runAlong(const Line& a, const Line& b, double reach);

/// Pairs of lines that may match or run along each other, ascending.
[[nodiscard]] std::vector<BoxPair> nearPairs(const std::vector<Line>& lines, double reach);

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
