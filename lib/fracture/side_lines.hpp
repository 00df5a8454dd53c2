#pragma once
// Free sides of bodies as lines, and which of them run along each other.

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

}  // namespace yadefrag
