#include "mesh/body_material.hpp"

#include <algorithm>

namespace yadefrag {

BodyMaterial boundOf(const MaterialPlaces& materials, const BrittlePlaces& places) {
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
