#pragma once
// A step that is refused changes nothing. What it has changed by then is put back: positions and
// velocities by ExplicitDynamics::takeBack, contact by Contact::takeBack, the rest from here.
//
// Rejected: to copy the world. Large arrays are exchanged with what the step writes anyway, or kept
// when a search replaces them, so that a step that is not refused pays for some numbers alone.

#include <cmath>
#include <cstdint>
#include <vector>

#include "contact/candidates.hpp"
#include "dynamics/element_kernel.hpp"
#include "dynamics/energy_ledger.hpp"
#include "step/apart_bodies.hpp"
#include "step/energy_watch.hpp"
#include "step/search_state.hpp"

namespace yadefrag {

/// How far and how fast nodes are, and may be until the next search.
struct MotionBounds {
  double largest = 0;          ///< m, of a watched node from xⁿ to x*; a bound
  double most = 0;             ///< m, of any node; a bound
  bool isQuiet = false;        ///< no body can come near another in this step
  double farthest = INFINITY;  ///< m, no surface node is farther from its place at the last search
  double fastest = 0;          ///< m/s, of all nodes when the halo was chosen
};

struct StepUndo {
  // --- how far the step has come
  bool hasMoved = false, hasSearched = false, hasCandidates = false, hasCorrected = false;

  // --- as it was when the step began
  EnergyLedger ledger;
  EnergyWatch watch;
  MotionBounds motion;
  double stableStep = 0;  ///< s
  BulkViscosity stableViscosity;
  double speedLimit = 0;     ///< m/s
  double spare = 0;          ///< m, of bodies that are apart
  std::vector<Vec2> driven;  ///< m/s, of nodes that have a motion; empty until the step sets them

  // --- of a step that searches
  SearchState search;
  ApartBodies apart;
  Candidates candidates;
  std::uint64_t numSearches = 0;
};

}  // namespace yadefrag
