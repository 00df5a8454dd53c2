// Back to where a step began that is refused.

#include <utility>

#include "step/world.hpp"

namespace yadefrag {

void World::beginUndo() {
  undo_.hasMoved = undo_.hasSearched = undo_.hasCandidates = undo_.hasCorrected = false;
  undo_.candidates.clear();
  undo_.driven.clear();
  undo_.ledger = ledger;
  undo_.motion = motion_;
  undo_.watch = watch;
  undo_.stableStep = stableStep, undo_.stableViscosity = stableViscosity;
  undo_.speedLimit = dynamics_.speedLimit();
  undo_.spare = apart_.spare();
}

/// Before the step chooses other nodes to watch, or other candidates.
void World::keepSearch() {
  if (undo_.hasSearched) return;
  undo_.search = search;
  undo_.apart = apart_;
  undo_.numSearches = numSearches;
  undo_.hasSearched = true;
}

/// Needs no memory.
void World::takeBack() {
  if (undo_.hasCorrected) contact.takeBack();
  if (undo_.hasSearched && !undo_.hasCandidates) search_.reset();  // it may have broken off
  if (undo_.hasCandidates) contact.candidates = std::move(undo_.candidates);
  if (undo_.hasSearched) {
    std::swap(search, undo_.search);
    std::swap(apart_, undo_.apart);
    numSearches = undo_.numSearches;
  }
  if (undo_.hasMoved) dynamics_.takeBack(model);
  letDrivenGo();
  ledger = undo_.ledger;
  motion_ = undo_.motion;
  watch = undo_.watch;
  stableStep = undo_.stableStep, stableViscosity = undo_.stableViscosity;
  dynamics_.watchSpeed(undo_.speedLimit);
  apart_.restoreSpare(undo_.spare);
}

}  // namespace yadefrag
