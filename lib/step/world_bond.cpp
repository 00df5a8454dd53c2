// World: bonds between bodies.

#include "core/errors.hpp"
#include "fracture/bonds.hpp"
#include "step/coverage.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// none() for both: all bodies, as far as their sides match.
std::size_t World::bond(ComponentId a, ComponentId b, double strength, double energy) {
  checkBond(strength, energy);
  std::vector<std::array<Side, 2>> sides;
  if (a == ComponentId::none() && b == ComponentId::none()) {
    sides = commonSides(model, fracture.edges, bodiesOf(model)).pairs;
    if (sides.empty()) return 0;
  } else {
    requireBody(a, "bond");
    requireBody(b, "bond");
    if (a == b) throw InputError("A body cannot be bonded to itself; joints= is for that.");
    sides = matchingSides(model, fracture.edges, a, b);
  }
  fracture.bond(model, sides, strength, energy, reference);
  stableStep = 0;
  isBuilt_ = false;
  return sides.size();
}

}  // namespace yadefrag
