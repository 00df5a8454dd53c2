#pragma once
// Data of the bodies of a scene: what a step continues (WorldState), what it may throw away
// (Scratch), and what its caller sets before it and reads after it (Settings, Exchange).

#include <cstdint>
#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "contact/pass_rule.hpp"
#include "core/step_times.hpp"
#include "elements/element_state.hpp"
#include "elements/plastic_flow.hpp"
#include "fracture/fracture.hpp"
#include "fracture/loose_fragments.hpp"
#include "mesh/model.hpp"
#include "step/energy_watch.hpp"
#include "step/loads.hpp"
#include "step/overlap_check.hpp"
#include "step/search_schedule.hpp"
#include "surface/contact_surface.hpp"
#include "time/energy_ledger.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

/// Fragments that were removed because they were too small; their energy is in the ledger.
struct Dropped {
  double mass = 0;          ///< kg
  Vec2 momentum = {};       ///< kg m/s, at their removal
  std::uint64_t count = 0;  ///< number of fragments
};

/// The small part of the state, which is copied before each step and restored when it is refused.
struct StepFigures {
  EnergyLedger ledger;
  EnergyWatch watch;
  /// (s) The longest step found stable since bodies were added or removed, with this viscosity.
  double stableStep = 0;
  BulkViscosity stableViscosity;
};

/// All that the next step depends on, besides settings: it is saved, and checked after loading.
struct WorldState : StepFigures {
  Model model;
  ContactSurfaces surfaces;
  Loads loads;
  Contact contact;
  SearchSchedule search;
  Fracture fracture;
  std::vector<std::string> warnings;  ///< all messages of the watch so far
  Dropped dropped;
  std::uint64_t steps = 0;
  double time = 0;                         ///< s
  double lastDt = 0;                       ///< s
  PlasticFlow::Steepness loadedSteepness;  ///< that of `stableStep`; taken over at the next step

  /// (J) At the last half step.
  [[nodiscard]] double kineticEnergy() const { return yadefrag::kineticEnergy(model.nodes); }
  [[nodiscard]] double strainEnergy() const { return yadefrag::strainEnergy(model, lastDt); }
  /// (J) Half of the plastic work in the last motion, which the ledger does not contain yet: the
  /// sum of all energies is that of the half step.
  [[nodiscard]] double pendingPlastic() const { return yieldingEnergy(model, lastDt).dissipated; }
  [[nodiscard]] double energy() const {
    return kineticEnergy() + strainEnergy() + pendingPlastic();
  }
};

/// Returns an empty string if every array has its length, every index is in range, every list is
/// consistently linked, and every divisor is positive and finite; otherwise the invalid part. For
/// states from files (state_check.cpp).
[[nodiscard]] std::string findInvalidPart(const WorldState& state);

struct Settings {
  StepSettings dynamicsSettings;
  ContactSettings contactSettings;
  int threads = 1;
  bool timing = false;  ///< fill `Exchange::times`
};

/// Not part of the state; the reactions are saved beside it.
struct Exchange {
  // --- for the next step only
  /// (m/s) By node: of nodes whose motion has a function.
  std::vector<Vec2> givenVelocities;
  /// (m/s) By index in `Scratch::rigidNodes`; empty: they do not move.
  std::vector<Vec2> rigidVelocities;
  /// Rigid boundaries that obey forces: contact forces change their velocity in the step. Empty:
  /// all have the velocities above.
  RigidMasses rigidMasses;

  // --- of the last step
  /// (N) Reactions by node, in held directions: the force that the prescribed motion requires,
  /// besides weight, loads and all forces of bodies. Empty before the first step.
  std::vector<Vec2> reactions;
  StageTimes times;  ///< of all steps so far
};

/// A refused step changes nothing. All changes until then are undone: positions and velocities by
/// ExplicitDynamics::undo, contact by Contact::undo, the search by SearchSchedule::undo, all
/// other data from here.
///
/// Rejected: a copy of the state. Large arrays are swapped with those that the step writes in any
/// case, or kept when a search replaces them, so that a successful step only copies some numbers.
struct StepUndo {
  bool hasMoved = false, hasCorrected = false;  ///< completed stages of the step
  StepFigures former;
  PlasticFlow::Steepness steepness;
  double speedLimit = 0;     ///< m/s
  std::vector<Vec2> driven;  ///< m/s, of nodes with a motion; empty until the step sets them
};

/// Made from the state, or without a meaning after a step.
struct Scratch {
  ExplicitDynamics dynamics;
  std::vector<NodeId> rigidNodes;  ///< of all rigid boundaries, ascending
  bool isBuilt = false;     ///< the data below fit the model: many bodies join, then one step comes
  bool canTouch = false;    ///< a single body that cannot touch itself needs no search
  double finest = 0;        ///< m, shortest stress-free segment
  double droppedBelow = 0;  ///< m², no detached fragment is smaller; 0: unknown
  BodyPlaces places;
  SplitResult split;
  LooseFragments loose;
  std::vector<Vec2> surfaceForces;  ///< N, by node, of contact and cohesion
  double ofChange = 0;              ///< J, see EnergyWatch::addOfChange
  StepUndo undo;
  std::string broken;  ///< reason why the state is invalid; empty: it is valid
};

/// What the stages of a step work on.
struct StepData {
  WorldState& state;
  Scratch& scratch;
  Exchange& exchange;
  const Settings& settings;

  [[nodiscard]] StageTimes* times() const { return settings.timing ? &exchange.times : nullptr; }
  /// αΔt/2
  [[nodiscard]] double drag(const StepLength& length) const {
    return settings.dynamicsSettings.drag(length);
  }
};

}  // namespace yadefrag
