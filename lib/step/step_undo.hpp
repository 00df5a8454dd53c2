#pragma once
// A step that is refused changes nothing. What it has changed by then is put back: positions and
// velocities by ExplicitDynamics::takeBack, contact by Contact::takeBack, the search by
// HaloWatch::takeBack, the rest from here.
//
// Rejected: to copy the world. Large arrays are exchanged with what the step writes anyway, or kept
// when a search replaces them, so that a step that is not refused pays for some numbers alone.

#include <vector>

#include "dynamics/element_kernel.hpp"
#include "dynamics/energy_ledger.hpp"
#include "step/energy_watch.hpp"

namespace yadefrag {

struct StepUndo {
  // --- how far the step has come
  bool hasMoved = false, hasCorrected = false;

  // --- as it was when the step began
  EnergyLedger ledger;
  EnergyWatch watch;
  double stableStep = 0;  ///< s
  BulkViscosity stableViscosity;
  double speedLimit = 0;     ///< m/s
  std::vector<Vec2> driven;  ///< m/s, of nodes that have a motion; empty until the step sets them
};

}  // namespace yadefrag
