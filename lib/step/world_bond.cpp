// World: bonds between bodies.

#include "core/errors.hpp"
#include "fracture/bonds.hpp"
#include "step/world.hpp"

namespace yadefrag {

std::size_t World::bond(ComponentId a, ComponentId b, double strength, double energy) {
  checkBond(strength, energy);
  requireBody(a, "bond");
  requireBody(b, "bond");
  if (a == b) throw InputError("A body cannot be bonded to itself; joints= is for that.");
  const std::vector<std::array<Side, 2>> sides = matchingSides(model, fracture.edges, a, b);
  fracture.bond(model, sides, strength, energy, reference);
  stableStep = 0;
  isBuilt_ = false;
  return sides.size();
}

}  // namespace yadefrag
