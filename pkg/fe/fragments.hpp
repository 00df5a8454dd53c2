#pragma once
// Parts of the mesh that hang together.

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
  Vec2 centroid;    ///< m, of the mass
  Vec2 velocity;    ///< m/s, of the centroid
  double spin = 0;  ///< rad/s: angular momentum over moment of inertia
};

/// All fragments, by their first triangle. Triangles with a common node hang together.
/// `ofTriangle`, unless it is null: the number of each triangle's fragment, 2³² − 1 of those that
/// were dropped. `holding`, unless it is null: what its cracks still hold counts as one.
std::vector<Fragment> findFragments(const Model& model,
                                    std::vector<std::uint32_t>* ofTriangle = nullptr,
                                    const Fracture* holding = nullptr);

}  // namespace yadefrag
