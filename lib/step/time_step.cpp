// One step of all bodies, in the order of the paper (§2, §4, §5).

#include <sstream>

#include "core/errors.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// All or nothing: whatever is thrown before the step is certain, it has not been.
void World::step(double dt) {
  if (!broken_.empty()) throw RunError(broken_);
  buildIfChanged();
  beginUndo();
  try {
    requireStableStep(dt);
    advance(dt);
  } catch (const RunError& error) {
    takeBack();
    std::ostringstream text;
    text << "Step " << steps << ", time " << time << " s: " << error.what();
    throw RunError(text.str());
  } catch (...) {
    takeBack();
    throw;
  }
  try {
    conclude(dt);
  } catch (...) {
    // What has split in part cannot be mended: mostly there was no memory.
    broken_ = "A step broke off while cracks opened; load a saved state.";
    throw;
  }
}

/// From xⁿ, vⁿ⁻½ to xⁿ⁺¹, vⁿ⁺½.
void World::advance(double dt) {
  const StepLength length(dt, lastDt);
  // The leapfrog's energy is that of a step: before the first one there is none.
  if (steps == 0) watch.begin(kineticEnergy() + yadefrag::strainEnergy(model, dt), ledger);
  drive(dt);
  sumOuterForces();
  search.foreseeMotion(searchScene(), dt);

  // Internal forces, then v* and x*, as if there were no contact.
  predict(length);
  absorb(length);

  // What still holds cracks together.
  cohere(length);
  requireBoundedMotion(dt);

  // Global search, only if a node left the halo of the last one: mostly a collider has searched, or
  // the last candidates still hold.
  if (canTouch()) {
    search.measureMove(searchScene(), dt);
    search.searchIfLeft(searchScene(), dt);
    requireResolvedMotion(dt);
    // Local search and correction, from x*, v* to xⁿ⁺¹, vⁿ⁺½. Contact forces act at xⁿ.
    correctContact(length);
    bookContact(length);
  }
  requireUpright(dt);

  // Works of everything but contact, with the mean of both velocities.
  finish(length);
  bookFracture(length);
  requireFiniteEnergy();
}

/// What follows from the new state, which stands.
void World::conclude(double dt) {
  measureReactions(StepLength(dt, lastDt));
  ++steps;
  time += dt;
  lastDt = dt;
  outerForces.clear();
  givenVelocities.clear();
  rigidVelocities.clear();
  givenPressures.clear();
  watchEnergy();

  // Cracks at xⁿ⁺¹: nodes split, surfaces are linked anew, and the new faces are candidates. What
  // is too small to be followed goes.
  const bool split = crack();
  dropFragments(split);

  if (canTouch()) search.foreseeSearch(searchScene(), dt);
}

void World::predict(const StepLength& length) {
  const StageTimer timer(timesIfAsked(), &StageTimes::forces);
  dynamics_.predict(model, length, dynamicsSettings, allOuterForces(), threads);
  undo_.hasMoved = true;
}

void World::requireUpright(double dt) {
  const StageTimer timer(timesIfAsked(), &StageTimes::forces);
  dynamics_.requireUpright(model, dt, canTouch() ? contact.largestCorrection() : 0);
}

void World::finish(const StepLength& length) {
  const StageTimer timer(timesIfAsked(), &StageTimes::forces);
  // Held nodes push back against contact and against cracks that still hold.
  pushes_ = contact.forces().known;
  if (!fracture.cohesion.edge.empty()) {
    surfaceForces_.assign(pushes_.begin(), pushes_.end());
    surfaceForces_.resize(model.nodes.size());
    fracture.cohesion.addForces(surfaceForces_);
    pushes_ = surfaceForces_;
  }
  dynamics_.finish(model, length, dynamicsSettings, allOuterForces(), pushes_, ledger, threads);
  if (!absorbing.segments.empty())
    absorbing.book(ledger, model, dynamics_.previousVelocity(), length);
}

void World::measureReactions(const StepLength& length) {
  if (dynamics_.holdsNone()) return reactions.clear();
  const StageTimer timer(timesIfAsked(), &StageTimes::forces);
  dynamics_.measureReactions(model, length, dynamicsSettings, allOuterForces(), pushes_, reactions);
}

}  // namespace yadefrag
