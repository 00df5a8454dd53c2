#include "time/energy_ledger.hpp"

#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

/// (J/m) Twice an element's energy at the half step, per depth.
double twiceEnergy(const Model& model, ElementId element, const Moduli& moduli, double dt) {
  const auto [lame, shear] = moduli;
  const Deformation now = deformation(model, element);
  const Deformation before = deformationBefore(model, element, now, dt);
  const HoopStress after = hoopStress(now.plane, now.hoop - 1, lame, shear),
                   former = hoopStress(before.plane, before.hoop - 1, lame, shear);
  return model.triangles.area[element.value] *
         (energyDensity(now.plane, lame, shear, now.hoop - 1) +
          energyDensity(before.plane, lame, shear, before.hoop - 1) -
          contract(after.plane - former.plane, now.plane - before.plane) / 2 -
          (after.hoop - former.hoop) * (now.hoop - before.hoop) / 2 +
          twiceBarrierEnergy(now, before, lame + 2 * shear));
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
  std::vector<ElementId> all;
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    if (!model.triangles.isDropped(e)) all.emplace_back(e);
  return strainEnergy(model, dt, all);
}

double strainEnergy(const Model& model, double dt, std::span<const ElementId> elements) {
  double sum = smoothedEnergy(model, elements, dt) + yieldingEnergy(model, elements, dt).strain;
  for (const ElementId element : elements) {
    const Component& c = model.bodyOf(element);
    if (c.element == ElementKind::kLinear && !c.yields())
      sum += twiceEnergy(model, element, Moduli(model.materialOf(element).material), dt) *
             model.depthOf(element) / 2;
  }
  return sum;
}

}  // namespace yadefrag
