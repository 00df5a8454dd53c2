// The world's part in bonds between bodies.

#include <sstream>

#include "core/errors.hpp"
#include "fracture/bonds.hpp"
#include "step/world.hpp"

namespace yadefrag {

std::size_t World::bond(ComponentId a, ComponentId b, double strength, double energy) {
  checkBond(strength, energy);
  for (const ComponentId one : {a, b}) {
    if (one.value < model.components.size() &&
        model.components[one.value].firstTriangle != model.components[one.value].lastTriangle)
      continue;
    throw InputError("There is no body " + std::to_string(one.value) + " to bond.");
  }
  if (a == b) throw InputError("A body cannot be bonded to itself; joints= is for that.");
  const std::vector<std::array<Side, 2>> sides = matchingSides(model, fracture.edges, a, b);
  fracture.bond(model, sides, strength, energy, reference);
  stableStep = 0;
  isBuilt_ = false;
  return sides.size();
}

}  // namespace yadefrag
