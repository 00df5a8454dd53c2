// Restores the state before a refused step.

#include "step/world.hpp"

namespace yadefrag {

void World::beginUndo() {
  undo_.hasMoved = undo_.hasCorrected = false;
  undo_.driven.clear();
  undo_.ledger = ledger;
  undo_.watch = watch;
  undo_.stableStep = stableStep, undo_.stableViscosity = stableViscosity;
  undo_.steepness = dynamics_.flow().steepness();
  undo_.speedLimit = dynamics_.speedLimit();
  search.begin();
}

/// Allocates no memory.
void World::takeBack() {
  search.takeBack(searchScene());
  if (undo_.hasCorrected) contact.takeBack();
  if (undo_.hasMoved) dynamics_.takeBack(model);
  undoDrive();
  ledger = undo_.ledger;
  watch = undo_.watch;
  stableStep = undo_.stableStep, stableViscosity = undo_.stableViscosity;
  dynamics_.flow().restore(undo_.steepness);
  dynamics_.setSpeedLimit(undo_.speedLimit);
}

}  // namespace yadefrag
