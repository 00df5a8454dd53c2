#include "dynamics/energy_ledger.hpp"

#include "dynamics/element_state.hpp"

namespace yadefrag {

double kineticEnergy(const Nodes& nodes) {
  double twice = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    twice += nodes.mass[n] * dot(nodes.velocity[n], nodes.velocity[n]);
  return twice / 2;
}

double strainEnergy(const Model& model, double dt) {
  double sum = 0;
  for (const Component& c : model.components) {
    const double lame = c.material.lame();
    const double shear = c.material.shearModulus();
    double density = 0;
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      const Matrix2 now = deformationGradient(model, ElementId(e));
      const Matrix2 before = now - deformationStep(model, ElementId(e), dt);
      const Matrix2 stress = firstPiola(now, lame, shear) - firstPiola(before, lame, shear);
      density += model.triangles.area[e] *
                 (energyDensity(now, lame, shear) + energyDensity(before, lame, shear) -
                  contract(stress, now - before) / 2);
    }
    sum += density * c.thickness / 2;
  }
  return sum;
}

}  // namespace yadefrag
