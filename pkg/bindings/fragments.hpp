#pragma once
// Connected parts of the mesh.

#include <cstdint>
#include <vector>

#include "fracture/fracture.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

struct Fragment {
  ComponentId component;
  std::uint32_t triangles = 0;
  double mass = 0;  ///< kg
  double area = 0;  ///< m², at the present positions
  Vec2 centroid;    ///< m, centre of mass
  Vec2 velocity;    ///< m/s, of the centroid
  double spin = 0;  ///< rad/s: angular momentum over moment of inertia
};

/// All fragments, in the order of their first triangles. Triangles with a common node are
/// connected. `ofTriangle`, if not null: the number of each triangle's fragment, 2³² − 1 for
/// removed triangles. `holding`, if not null: parts that its cohesive cracks connect count as one
/// fragment.
std::vector<Fragment> findFragments(const Model& model,
                                    std::vector<std::uint32_t>* ofTriangle = nullptr,
                                    const Fracture* holding = nullptr);

}  // namespace yadefrag
