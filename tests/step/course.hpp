#pragma once
// A run with a record: points on the wrong side, and energy created.

#include <algorithm>
#include <cmath>

#include "step/bodies.hpp"
#include "step/wrong_side.hpp"

namespace yadefrag::test {

struct Course {
  double deepest = 0;       ///< of the shortest segment: a boundary node in another body
  double penetration = 0;   ///< of the shortest segment: what the correction left
  double growth = 0;        ///< of the start's energy: kinetic + strain
  double drift = 0;         ///< of the start's energy: the ledger's total, either way
  std::size_t touched = 0;  ///< rows with a force, over all steps
};

/// `every`: steps between two looks, which cost more than the steps.
inline Course watch(World& world, int steps, int every, double ofCritical = .5) {
  const double dt = ofCritical * world.criticalTimeStep();
  const double start = world.kineticEnergy() + world.strainEnergy();
  const double total = totalEnergy(world);
  Course course;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    course.penetration =
        std::max(course.penetration, world.contact.maxPenetration() / world.search.shortest);
    course.touched += world.contact.rows().size();
    if (i % every != 0) continue;
    course.deepest = std::max(course.deepest, deepestNode(world) / world.search.shortest);
    const double now = world.kineticEnergy() + world.strainEnergy();
    course.growth = std::max(course.growth, now / start - 1);
    course.drift = std::max(course.drift, std::abs(totalEnergy(world) / total - 1));
  }
  return course;
}

/// Rubber, soft enough that blows of some m/s deform bodies visibly.
inline ElasticMaterial rubber() { return {1e7, .3, 1000, false}; }

}  // namespace yadefrag::test
