#pragma once
// The material of a triangle, and the assignment of materials to the triangles of a body.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/brittle_material.hpp"
#include "mesh/elastic_material.hpp"
#include "mesh/plastic_material.hpp"

namespace yadefrag {

struct BodyMaterial {
  ElasticMaterial material;
  BrittleMaterial brittle;
  double friction = 0;  ///< tan of the friction angle
  PlasticMaterial plastic;
};

/// (Pa) Strength of an edge that never cracks, in a body with edges that can.
inline constexpr double kUnbreakable = std::numeric_limits<double>::max();

/// Fracture of a material that cracks only where it has failed: an edge gets its strength then.
[[nodiscard]] inline BrittleMaterial untilFailure(const FailureLaw& law) {
  return {.tensileStrength = kUnbreakable, .fractureEnergy = law.energy};
}

/// The materials of a body with several; empty for a body with one.
struct MaterialPlaces {
  std::vector<BodyMaterial> materials;
  std::vector<std::uint32_t> ofTriangle;  ///< number of the material, by triangle of the mesh

  [[nodiscard]] bool empty() const { return materials.empty(); }
};

/// One material that bounds all materials of a body: the elasticity of the first one, and bounds
/// for fracture: the least strength (joints included), shear factor and friction. The strength is 0
/// if no edge can crack.
[[nodiscard]] inline BodyMaterial boundOf(const MaterialPlaces& materials,
                                          const BrittlePlaces& places) {
  BodyMaterial bound = materials.materials.front();
  bound.brittle = {};
  bound.brittle.shearFactor = std::numeric_limits<double>::infinity();
  double least = kUnbreakable;
  bool cracks = !places.joints.empty();
  for (const BodyMaterial& one : materials.materials) {
    bound.friction = std::min(bound.friction, one.friction);
    bound.brittle.shearFactor = std::min(bound.brittle.shearFactor, one.brittle.shearFactor);
    if (!one.brittle.cracks()) continue;
    cracks = true;
    least = std::min(least, one.brittle.tensileStrength);
  }
  for (const JointEdge& joint : places.joints)
    if (joint.strength > 0) least = std::min(least, joint.strength);
  if (cracks) bound.brittle.tensileStrength = least;
  return bound;
}

}  // namespace yadefrag
