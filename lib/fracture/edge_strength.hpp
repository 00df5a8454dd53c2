#pragma once
// Strength and material of edges.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "fracture/cohesive_law.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/body_material.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

// --- Strengths of the edges of a brittle body.

/// (Pa) Strength of one edge. It depends only on the material, its seed and the edge's number, so
/// that it is the same in any order of calls and on any thread. With a Weibull modulus m: the
/// two-parameter distribution of W. Weibull 1951 (J. Appl. Mech. 18, 293, without a lower limit),
/// P(strength < s) = 1 − exp(−(s/σc)ᵐ). σc is therefore the scale, below which 63 % of the edges
/// are; the mean is σc·Γ(1 + 1/m). With a scatter s: uniform in σc(1 ± s). With both: their product
/// over σc. With a reference volume V₀ the scale of an edge is σc(V₀/V)^(1/m), where V is the
/// `volume` (m³) that belongs to the edge. The weakest of n edges that share a volume then has the
/// same distribution for any n: a finer mesh is not weaker (Zhou and Molinari 2004, Int. J. Solids
/// Struct. 41, 6573).
[[nodiscard]] double edgeStrength(const BrittleMaterial& material, std::uint64_t edge,
                                  double volume = 0);

/// (Pa) Probable strength of the strongest of `edges` edges of this volume (m³): by the Weibull
/// distribution one of them would be stronger, by the uniform one none.
[[nodiscard]] double likelyLargestStrength(const BrittleMaterial& material, std::size_t edges,
                                           double volume = 0);

/// Factor of the failure strain and of the spall stress of one triangle, of the same scatter: as
/// the strength of an edge whose material has the strength 1. `volume` (m³): of the triangle.
[[nodiscard]] inline double scatterFactor(BrittleMaterial material, std::uint64_t triangle,
                                          double volume) {
  material.tensileStrength = 1;
  return edgeStrength(material, triangle, volume);
}

// --- Material of an edge between two triangles of different materials: that of the weaker one.

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
