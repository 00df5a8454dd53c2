#pragma once
// Positions of the nodes inside a body.

#include <vector>

#include "meshing/divided_boundary.hpp"
#include "meshing/mesh_layout.hpp"
#include "meshing/size_field.hpp"

namespace yadefrag {

/// Advancing front: nodes are added from the boundary inwards until the fronts meet. They are
/// placed at the corners of nearly equilateral triangles, or at random points where the Poisson
/// disks around all nodes leave room (Bridson 2007; a maximal sampling, Ebeida et al. 2011, except
/// for gaps that 30 tries missed). A few may be outside where the boundary is finer than its
/// surroundings.
[[nodiscard]] std::vector<Vec2> fillInterior(const DividedBoundary& boundary, const SizeField& size,
                                             MeshLayout layout = {});

}  // namespace yadefrag
