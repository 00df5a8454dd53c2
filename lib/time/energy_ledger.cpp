#include "time/energy_ledger.hpp"

#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

/// (J/m) Twice an element's energy at the half step, per thickness.
double twiceEnergy(const Model& model, ElementId element, const Moduli& moduli, double dt) {
  const auto [lame, shear] = moduli;
  const Matrix2 now = deformationGradient(model, element);
  const Matrix2 before = now - deformationStep(model, element, dt);
  const Matrix2 stress = firstPiola(now, lame, shear) - firstPiola(before, lame, shear);
  return model.triangles.area[element.value] *
         (energyDensity(now, lame, shear) + energyDensity(before, lame, shear) -
          contract(stress, now - before) / 2 + twiceBarrierEnergy(now, before, lame + 2 * shear));
}

}  // namespace

double kineticEnergy(const Nodes& nodes) {
  double twice = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    twice += nodes.mass[n] * dot(nodes.velocity[n], nodes.velocity[n]);
  return twice / 2;
}

double sumOfSpins(const Nodes& nodes) {
  Vec2 centre;
  double mass = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    centre += nodes.mass[n] * nodes.position[n], mass += nodes.mass[n];
  centre *= 1 / mass;
  double sum = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    sum += nodes.mass[n] * norm(nodes.position[n] - centre) * norm(nodes.velocity[n]);
  return sum;
}

double moment(std::span<const Vec2> positions, std::span<const Vec2> forces) {
  double sum = 0;
  for (std::size_t n = 0; n < forces.size(); ++n) sum += cross(positions[n], forces[n]);
  return sum;
}

double strainEnergy(const Model& model, double dt) {
  double sum = smoothedEnergy(model, dt) + yieldingEnergy(model, dt).strain;
  for (const Component& c : model.components) {
    if (c.element == ElementKind::kSmoothed || c.yields()) continue;
    double twice = 0;
    Moduli moduli(c.material);
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      moduli.take(model, c, ElementId(e));
      twice += twiceEnergy(model, ElementId(e), moduli, dt);
    }
    sum += twice * c.thickness / 2;
  }
  return sum;
}

double strainEnergy(const Model& model, double dt, std::span<const ElementId> elements) {
  double sum = smoothedEnergy(model, elements, dt) + yieldingEnergy(model, elements, dt).strain;
  for (const ElementId element : elements) {
    const Component& c = model.bodyOf(element);
    if (c.element == ElementKind::kLinear && !c.yields())
      sum += twiceEnergy(model, element, Moduli(model.materialOf(element).material), dt) *
             c.thickness / 2;
  }
  return sum;
}

}  // namespace yadefrag
