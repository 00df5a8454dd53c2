#pragma once
// A run with a record: points on the wrong side, and energy created.

#include <algorithm>
#include <cmath>

#include "step/bodies.hpp"
#include "step/wrong_side.hpp"

namespace yadefrag::test {

struct RunResult {
  double deepest = 0;       ///< of the shortest segment: a boundary node in another body
  double penetration = 0;   ///< of the shortest segment: what the correction left
  double growth = 0;        ///< of the start's energy: kinetic + strain
  double drift = 0;         ///< of the start's energy: the ledger's total, either way
  std::size_t touched = 0;  ///< rows with a force, over all steps
};

/// `every`: steps between two looks, which cost more than the steps.
inline RunResult watch(World& world, int steps, int every, double ofCritical = .5) {
  const double dt = ofCritical * world.criticalTimeStep();
  const double start = world.kineticEnergy() + world.strainEnergy();
  const double total = totalEnergy(world);
  RunResult result;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    result.penetration =
        std::max(result.penetration, world.contact.maxPenetration() / world.search.shortest);
    result.touched += world.contact.rows().size();
    if (i % every != 0) continue;
    result.deepest = std::max(result.deepest, deepestNode(world) / world.search.shortest);
    const double now = world.kineticEnergy() + world.strainEnergy();
    result.growth = std::max(result.growth, now / start - 1);
    result.drift = std::max(result.drift, std::abs(totalEnergy(world) / total - 1));
  }
  return result;
}

/// Rubber, soft enough that blows of some m/s deform bodies visibly.
inline ElasticMaterial rubber() { return {1e7, .3, 1000, false}; }

}  // namespace yadefrag::test
