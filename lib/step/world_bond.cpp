// World: bonds between bodies.

#include <array>
#include <utility>

#include "core/errors.hpp"
#include "step/overlap_check.hpp"
#include "step/world.hpp"

namespace yadefrag {

std::size_t World::bond(ComponentId a, ComponentId b, double strength, double energy,
                        ConformPlan* done) {
  checkBond(strength, energy);
  requireBody(a, "bond");
  requireBody(b, "bond");
  if (a == b) throw InputError("A body cannot be bonded to itself; joints= is for that.");
  const CommonSides found = conformedSides(
      std::array{a, b}, 0, [&](const CommonSides& sides) { requireMatch(sides, a, b); }, done);
  bond(found, strength, energy);
  return found.pairs.size();
}

CommonSides World::bondAll(double reach, double strength, double energy, ConformPlan* done) {
  checkBond(strength, energy);
  CommonSides found = conformedSides(bodiesOf(model), reach, {}, done);
  if (!found.pairs.empty()) bond(found, strength, energy);
  return found;
}

/// The common sides after those with different ends got the same ones, if that lets more of them
/// match. `check` may refuse the result; nothing is changed then.
CommonSides World::conformedSides(std::span<const ComponentId> bodies, double reach,
                                  const std::function<void(const CommonSides&)>& check,
                                  ConformPlan* done) {
  CommonSides found = commonSides(model, fracture.edges, bodies, reach);
  const auto accept = [&](const CommonSides& sides) {
    if (check) check(sides);
  };
  if (found.unmatched == 0) {
    accept(found);
    return found;
  }
  ConformPlan plan = planConforming(model, fracture.edges, bodies, reach);
  Model changed = model;
  CrackEdges edges = fracture.edges;
  const DividedSides divided = conform(changed, edges, surfaces, plan);
  found = commonSides(changed, edges, bodies, reach);
  accept(found);
  if (found.pairs.empty()) return found;
  model = std::move(changed), fracture.edges = std::move(edges);
  followDivision(divided);
  if (done != nullptr) *done = std::move(plan);
  return found;
}

/// Updates the boundary and all that refers to it.
void World::followDivision(const DividedSides& divided) {
  (void)relink(surfaces, divided.sides);
  loads.followDivision(surfaces, divided.parents);
  search.invalidate();
  places_.clear();
  rebuild();
  watch.begin(kineticEnergy() + strainEnergy() + pendingPlastic(), ledger);
}

void World::bond(const CommonSides& sides, double strength, double energy) {
  fracture.bond(model, sides.pairs, strength, energy);
  stableStep = 0;
  isBuilt_ = false;
}

}  // namespace yadefrag
