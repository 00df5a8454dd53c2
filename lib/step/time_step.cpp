// One step of all bodies, in the order of the paper (§2, §4, §5).

#include <fmt/core.h>

#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "step/world.hpp"

namespace yadefrag {

/// All or nothing: after an exception during the step the state is that before the step.
void World::step(double dt) {
  if (!broken_.empty()) throw RunError(broken_);
  buildIfChanged();
  beginUndo();
  try {
    requireStableStep(dt);
    advance(dt);
  } catch (const RunError& error) {
    takeBack();
    throw RunError(fmt::format("Step {}, time {:g} s: {}", steps, time, error.what()));
  } catch (...) {
    takeBack();
    throw;
  }
  try {
    conclude(dt);
  } catch (...) {
    // A partial split of nodes cannot be undone; its usual cause is a lack of memory.
    broken_ = "A step ended while cracks opened, and the state is incomplete; load a saved state.";
    throw;
  }
}

/// From xⁿ, vⁿ⁻½ to xⁿ⁺¹, vⁿ⁺½.
void World::advance(double dt) {
  const StepLength length(dt, lastDt);
  // The leapfrog's energy is that of a step: it is not defined before the first one.
  if (steps == 0) watch.begin(kineticEnergy() + yadefrag::strainEnergy(model, dt), ledger);
  drive(dt);
  loads.sum(model, surfaces, time);
  search.foreseeMotion(searchScene(), dt);

  // Internal forces, then v* and x*, without contact.
  predict(length);
  absorb(length);

  // Tractions of cohesive cracks.
  cohere(length);
  requireBoundedMotion(dt);

  // Global search, only if a node left the halo of the last one: usually the last candidates are
  // still valid.
  if (canTouch()) {
    search.measureMove(searchScene(), dt);
    search.searchIfLeft(searchScene(), dt);
    requireResolvedMotion(dt);
    // Local search and correction, from x*, v* to xⁿ⁺¹, vⁿ⁺½. Contact forces act at xⁿ.
    correctContact(length);
  }
  fracture.cohesion.finish(model.nodes, length);
  if (canTouch()) countContactWork(length);
  requireUpright(dt);

  // Work of all forces except contact, with the mean of both velocities.
  finish(length);
  countFractureWork(length);
  ofChange_ = dt != lastDt && lastDt > 0 ? dynamics_.energyOfChange(model, length) : 0;
  // Flow makes steps shorter, with no change of the script.
  if (dynamics_.flow().isOn()) ledger.external += std::exchange(ofChange_, 0);
  requireFiniteEnergy();
}

/// Consequences of the new state, which is final.
void World::conclude(double dt) {
  measureReactions(StepLength(dt, lastDt));
  ++steps;
  time += dt;
  lastDt = dt;
  loads.endStep();
  givenVelocities.clear();
  rigidVelocities.clear();
  rigidMasses.clear();
  watch.addOfChange(ofChange_);
  watchEnergy();

  // Cracks at xⁿ⁺¹: nodes split, surfaces are linked again, and the new faces become candidates.
  // Fragments that are too small are removed.
  const bool split = crack();
  dropFragments(split);

  if (canTouch()) search.foreseeSearch(searchScene(), dt);
}

void World::absorb(const StepLength& length) {
  if (loads.absorbing.segments.empty()) return;
  loads.absorbing.correct(model, surfaces, dynamics_.previousPosition(),
                          dynamics_.previousVelocity(), length, dynamicsSettings.drag(length));
}

void World::predict(const StepLength& length) {
  const StageTimer timer(timesIfRequested(), &StageTimes::forces);
  dynamics_.predict(model, length, dynamicsSettings, loads.forces(), threads);
  undo_.hasMoved = true;
  if (dynamics_.flow().isOn()) ledger.plastic += dynamics_.flow().dissipation();
}

void World::requireUpright(double dt) {
  const StageTimer timer(timesIfRequested(), &StageTimes::forces);
  const auto flattest =
      dynamics_.requireUpright(model, dt, canTouch() ? contact.largestCorrection() : 0);
  if (flattest.element == ElementId::none()) return;
  stableStep = dt;  // a longer step must be checked anew
  const double critical = criticalTimeStep();
  if (dt > critical)
    dynamics_.refuseFlat(model, flattest, dt, tolerance::kBarrierAdvised * critical);
}

void World::finish(const StepLength& length) {
  const StageTimer timer(timesIfRequested(), &StageTimes::forces);
  // Reactions of held nodes include contact and cohesive cracks.
  pushes_ = contact.forces().known;
  if (!fracture.cohesion.edge.empty()) {
    surfaceForces_.assign(pushes_.begin(), pushes_.end());
    surfaceForces_.resize(model.nodes.size());
    fracture.cohesion.addForces(surfaceForces_);
    pushes_ = surfaceForces_;
    ledger.spin +=
        length.velocity * moment(dynamics_.previousPosition(), std::span<const Vec2>(pushes_));
  }
  dynamics_.finish(model, length, dynamicsSettings, loads.forces(), pushes_, ledger, threads);
  if (!loads.absorbing.segments.empty())
    loads.absorbing.addWork(ledger, model, dynamics_.previousVelocity(), length);
}

void World::measureReactions(const StepLength& length) {
  if (dynamics_.holdsNone()) return reactions.clear();
  const StageTimer timer(timesIfRequested(), &StageTimes::forces);
  dynamics_.measureReactions(model, length, dynamicsSettings, loads.forces(), pushes_, reactions);
}

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
