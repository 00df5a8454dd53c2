#pragma once
// A refused step changes nothing. All changes until then are undone: positions and velocities by
// ExplicitDynamics::takeBack, contact by Contact::takeBack, the search by HaloWatch::takeBack, all
// other data from here.
//
// Rejected: a copy of the world. Large arrays are swapped with those that the step writes in any
// case, or kept when a search replaces them, so that a successful step only copies some numbers.

#include <vector>

#include "dynamics/element_kernel.hpp"
#include "dynamics/energy_ledger.hpp"
#include "dynamics/plastic_flow.hpp"
#include "step/energy_watch.hpp"

namespace yadefrag {

struct StepUndo {
  // --- completed stages of the step
  bool hasMoved = false, hasCorrected = false;

  // --- state at the begin of the step
  EnergyLedger ledger;
  EnergyWatch watch;
  double stableStep = 0;  ///< s
  BulkViscosity stableViscosity;
  PlasticFlow::Steepness steepness;
  double speedLimit = 0;     ///< m/s
  std::vector<Vec2> driven;  ///< m/s, of nodes with a motion; empty until the step sets them
};

}  // namespace yadefrag
