// World: check of energies and depths.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/tolerances/step.hpp"
#include "step/overlap_check.hpp"
#include "step/world.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {

/// (J) Every step rounds all coordinates, which releases energy of springs as stiff as the critical
/// step permits. The errors of single steps are independent, so that their energies add up.
double World::roundingEnergy() const {
  double moment = 0;  // kg m²
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    moment += model.nodes.mass[n] * dot(model.nodes.position[n], model.nodes.position[n]);
  const double rate = 2 * tolerance::kRounding / yadefrag::criticalTimeStep(model, {}, threads);
  return static_cast<double>(steps) * moment / 2 * rate * rate;
}

/// (J) Energy of a body's nodes, from `first` on, and of its elements, in a step of `dt` (s).
double World::energyOf(ComponentId body, NodeId first, double dt) const {
  double twice = 0;
  for (std::size_t n = first.value; n < model.nodes.size(); ++n)
    if (model.nodes.component[n] == body)
      twice += model.nodes.mass[n] * dot(model.nodes.velocity[n], model.nodes.velocity[n]);
  const Component& component = model.components[body.value];
  std::vector<ElementId> elements;
  for (std::size_t e = component.firstTriangle; e < component.lastTriangle; ++e)
    elements.emplace_back(e);
  return twice / 2 + yadefrag::strainEnergy(model, dt, elements);
}

/// (m) The deepest overlap of straight boundaries, at any point; arcs deviate from the triangles.
/// All points of bodies that can crack are slaves: only the other bodies, if two or more, are
/// checked.
double World::overlapOfBoundaries() const {
  const auto isChecked = [&](const Component& body) {
    return !body.rigid && !body.brittle.cracks();
  };
  if (std::ranges::count_if(model.components, isChecked) < 2) return 0;
  std::vector<std::uint8_t> straight(model.nodes.size());
  // Interior nodes may come last; nodeSegment ends before them.
  for (std::size_t n = 0; n < surfaces.nodeSegment.size(); ++n) {
    const SegmentId segment = surfaces.nodeSegment[n];
    straight[n] = segment != SegmentId::none() && !surfaces.isSmooth(segment) &&
                          isChecked(model.components[model.nodes.component[n].value])
                      ? 1
                      : 0;
  }
  return deepestOverlap(model, straight, threads);
}

/// Gives messages, but does not stop the run: only the user knows its purpose.
void World::watchEnergy() {
  const WatchedStep now{steps,   time,        lastDt, contact.maxPenetration(),
                        finest_, search.halo, ledger};
  const auto report = [this](std::string sentence) {
    if (!sentence.empty()) warnings.push_back(std::move(sentence));
  };
  watch.count(now);
  if (watch.mayHaveCreated(now)) report(watch.contactMessage(now, roundingEnergy()));
  if (EnergyWatch::isDue(steps)) {
    if (watch.mayHaveSpun(now)) report(watch.spinMessage(now, sumOfSpins(model.nodes)));
    const double kinetic = kineticEnergy();
    if (watch.mayHaveGrown(now, kinetic)) {
      const double energy = kinetic + strainEnergy() + pendingPlastic();
      const double grown = ledger.total(energy, 0) - watch.expected;
      // The energy of rounding takes long to compute; it is needed only if the excess is large.
      const bool isMuch = grown > tolerance::kGivenEnergy * watch.most;
      report(watch.growthMessage(now, energy, isMuch ? roundingEnergy() : 0));
    }
  }
  report(watch.depthMessage(now));
  if (contactSettings.passes == 1 && EnergyWatch::isOverlapDue(steps) && !contact.rows().empty())
    report(watch.overlapMessage(now, overlapOfBoundaries()));
}

}  // namespace yadefrag
