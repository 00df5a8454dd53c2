#pragma once
// Material of an edge between two triangles of different materials: that of the weaker one.

#include <algorithm>

#include "fracture/cohesive_law.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// The material with the smaller tensile strength; that of `a` if they are equal. A material that
/// never cracks is returned only if both never crack.
[[nodiscard]] inline const BodyMaterial& weakerOf(const Model& model, ElementId a, ElementId b) {
  const BodyMaterial& first = model.materialOf(a);
  const BodyMaterial& second = model.materialOf(b);
  if (!second.brittle.cracks()) return first;
  if (!first.brittle.cracks()) return second;
  return second.brittle.tensileStrength < first.brittle.tensileStrength ? second : first;
}

/// Fracture and friction between two triangles.
struct EdgeMaterial {
  const BrittleMaterial& brittle;  ///< of the weaker material
  double friction;                 ///< tan of the friction angle: the smaller one, as in contact
};

[[nodiscard]] inline EdgeMaterial materialBetween(const Model& model, ElementId a, ElementId b) {
  const Component& body = model.bodyOf(a);
  if (!body.isMixed() && model.triangles.component[a.value] == model.triangles.component[b.value])
    return {body.brittle, body.friction};
  return {weakerOf(model, a, b).brittle,
          std::min(model.materialOf(a).friction, model.materialOf(b).friction)};
}

/// (Pa) The modulus of the mean compliance of two.
[[nodiscard]] inline double modulusOfBoth(double first, double second) {
  return first == second ? first : 2 / (1 / first + 1 / second);
}

/// (Pa) σ/ε of a bar in tension, in plane stress or strain as the body; of their mean compliance.
[[nodiscard]] inline double modulusBetween(const Model& model, ElementId a, ElementId b) {
  const auto modulus = [&](ElementId e) {
    const ElasticMaterial& m = model.materialOf(e).material;
    return m.planeStress ? m.young : m.young / (1 - m.poisson * m.poisson);
  };
  return modulusOfBoth(modulus(a), modulus(b));
}

/// The law of an edge with its own strength and energy; the curve is that of the weaker material.
[[nodiscard]] inline TensionLaw tensionLaw(const Model& model, const CrackEdges& edges,
                                           EdgeId edge) {
  const auto [a, b] = edges.element[edge.value];
  const SofteningCurve& curve = materialBetween(model, a, b).brittle.softening;
  const double strength = edges.strength[edge.value];
  return {curve, strength, curve.criticalOpening(strength, edges.fractureEnergy[edge.value])};
}

}  // namespace yadefrag
