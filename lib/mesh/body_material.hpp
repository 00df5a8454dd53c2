#pragma once
// What the material of a triangle says, and which triangles of a body have which.

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/brittle_material.hpp"
#include "mesh/elastic_material.hpp"

namespace yadefrag {

struct BodyMaterial {
  ElasticMaterial material;
  BrittleMaterial brittle;
  double friction = 0;  ///< tan of the friction angle
};

/// (Pa) Strength of an edge that never cracks, in a body that does so elsewhere.
inline constexpr double kUnbreakable = std::numeric_limits<double>::max();

/// The materials of a body that has several; empty: it has one.
struct MaterialPlaces {
  std::vector<BodyMaterial> materials;
  std::vector<std::uint32_t> ofTriangle;  ///< number of its material, by triangle of the mesh

  [[nodiscard]] bool empty() const { return materials.empty(); }
};

/// What a body of several materials has in their place where it is looked at as a whole: the first
/// one's elasticity, and bounds of what it takes to crack: the least strength, of joints, too,
/// shear factor and friction. Its strength is 0 if no edge can crack.
[[nodiscard]] BodyMaterial boundOf(const MaterialPlaces& materials, const BrittlePlaces& places);

}  // namespace yadefrag
