#pragma once
// How an edge cracks whose two triangles may differ in material: as the weaker of the two.

#include <algorithm>

#include "mesh/model.hpp"

namespace yadefrag {

/// The material with the smaller tensile strength, of equal ones that of `a`; one that never cracks
/// only if the other does not either.
[[nodiscard]] inline const BodyMaterial& weakerOf(const Model& model, ElementId a, ElementId b) {
  const BodyMaterial& first = model.materialOf(a);
  const BodyMaterial& second = model.materialOf(b);
  if (!second.brittle.cracks()) return first;
  if (!first.brittle.cracks()) return second;
  return second.brittle.tensileStrength < first.brittle.tensileStrength ? second : first;
}

/// Tan of the friction angle between two triangles: the smaller one, as in contact.
[[nodiscard]] inline double frictionBetween(const Model& model, ElementId a, ElementId b) {
  return std::min(model.materialOf(a).friction, model.materialOf(b).friction);
}

}  // namespace yadefrag
