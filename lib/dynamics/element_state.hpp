#pragma once
// Deformation, stress and energy of single elements, for output.

#include <array>
#include <vector>

#include "dynamics/elastic_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// (Pa) Elastic moduli of successive elements: those of the body or of the element's own material.
class Moduli {
 public:
  explicit Moduli(const ElasticMaterial& m) : lame(m.lame()), shear(m.shearModulus()) {}
  /// Does nothing if the body has one material.
  void take(const Model& model, const Component& body, ElementId element) {
    if (body.isMixed()) *this = Moduli(model.materialOf(element).material);
  }

  double lame, shear;
};

/// (m³) Of the stress-free shape.
inline double volumeOf(const Model& model, ElementId element) {
  return model.triangles.area[element.value] * model.bodyOf(element).thickness;
}

/// The deformation gradient F at the present positions.
Matrix2 deformationGradient(const Model& model, ElementId element);

/// (1/m) Inverse of the edges of the stress-free shape, which flow has changed.
std::array<double, 4> elasticEdges(const Model& model, ElementId element);
/// The deformation gradient from that shape; F without flow.
Matrix2 elasticGradient(const Model& model, ElementId element);

/// Δt Ḟ: the change of F over a step at the present velocities.
Matrix2 deformationStep(const Model& model, ElementId element, double dt);

/// (Pa) Cauchy stress xx, yy, xy of the F of one element, without strain smoothing. Cracks average
/// it over the elements at a node, which is a smoothing of its own. `dt`: as below.
std::array<double, 3> stressOf(const Model& model, ElementId element, double dt = 0);
/// The same of an elastic element with these moduli.
std::array<double, 3> elasticStressOf(const Model& model, ElementId element, const Moduli& moduli);

/// (1/s) Rate of deformation xx, yy, xy of one element: the symmetric part of ḞF⁻¹.
std::array<double, 3> strainRateOf(const Model& model, ElementId element);

/// (Pa) The stress of every element from which its forces are computed.
/// `dt` (s): the last step, for bodies that yield; 0: their rate has no effect.
std::vector<std::array<double, 3>> stresses(const Model& model, double dt = 0);

/// (Pa) The stress zz across the plane; 0 in plane stress.
std::vector<double> stressesAcross(const Model& model, double dt = 0);

}  // namespace yadefrag
