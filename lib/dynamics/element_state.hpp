#pragma once
// Deformation, stress and energy of single elements, for those who ask.

#include <array>
#include <vector>

#include "dynamics/elastic_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// (Pa) Of elements one after the other: those of their body, or their own.
class Moduli {
 public:
  explicit Moduli(const ElasticMaterial& m) : lame(m.lame()), shear(m.shearModulus()) {}
  /// Costs nothing where the body has one material.
  void take(const Model& model, const Component& body, ElementId element) {
    if (body.isMixed()) *this = Moduli(model.materialOf(element).material);
  }

  double lame, shear;
};

/// F at the present positions.
Matrix2 deformationGradient(const Model& model, ElementId element);

/// Δt Ḟ: the change of F over a step at the present velocities.
Matrix2 deformationStep(const Model& model, ElementId element, double dt);

/// (Pa) Cauchy stress xx, yy, xy that belongs to the F of one element, whether its body's strains
/// are smoothed or not: cracks take the mean of these at a node, which smooths them.
std::array<double, 3> stressOf(const Model& model, ElementId element);

/// (Pa) Of every element, that which makes the forces.
std::vector<std::array<double, 3>> stresses(const Model& model);

/// (J) Strain energy of every element at the present positions.
std::vector<double> elementEnergies(const Model& model);

}  // namespace yadefrag
