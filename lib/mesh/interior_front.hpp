#pragma once
// Where the nodes inside a body go.

#include <vector>

#include "mesh/divided_boundary.hpp"

namespace yadefrag {

/// Nodes at the corners of nearly equilateral triangles, laid in rows from the boundary inwards
/// until the fronts meet. A few may be outside where the boundary is finer than its surroundings.
[[nodiscard]] std::vector<Vec2> fillInterior(const DividedBoundary& boundary, double size);

}  // namespace yadefrag
