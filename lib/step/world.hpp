#pragma once
// Complete state of the finite-element bodies of a scene, and the step that moves them
// (time_step.cpp).

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "contact/pass_rule.hpp"
#include "core/step_times.hpp"
#include "elements/element_kernel.hpp"
#include "elements/element_state.hpp"
#include "elements/plastic_flow.hpp"
#include "fracture/bonds.hpp"
#include "fracture/conform.hpp"
#include "fracture/fracture.hpp"
#include "fracture/loose_fragments.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "search/contact_search.hpp"
#include "step/energy_watch.hpp"
#include "step/loads.hpp"
#include "step/overlap_check.hpp"
#include "step/search_schedule.hpp"
#include "surface/contact_surface.hpp"
#include "time/energy_ledger.hpp"
#include "time/explicit_dynamics.hpp"

namespace yadefrag {

/// A refused step changes nothing. All changes until then are undone: positions and velocities by
/// ExplicitDynamics::undo, contact by Contact::undo, the search by SearchSchedule::undo, all
/// other data from here.
///
/// Rejected: a copy of the world. Large arrays are swapped with those that the step writes in any
/// case, or kept when a search replaces them, so that a successful step only copies some numbers.
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

/// Properties of a body besides its mesh. Arrays are by node of the mesh; empty ones mean zeros.
struct BodySpec : BodyMaterial {
  MaterialPlaces materials;  ///< replace the one above, if there are several
  /// Of a material that yields and fails: `strength` are factors of the failure strain and of the
  /// spall stress, without joints; the scatter of `brittle` is that of these, too.
  BrittlePlaces places;
  double thickness = 1;  ///< m
  bool selfContact = true;
  bool rigid = false;  ///< only for the check of overlaps
  ElementKind element = ElementKind::kLinear;
  std::vector<Vec2> velocity;      ///< m/s
  std::vector<Vec2> displacement;  ///< m, from the stress-free shape
  /// Pa (Cauchy; xx, yy, xy), by triangle, in the shape of the mesh; empty: none.
  std::vector<std::array<double, 3>> stress;
  std::vector<double> stressAcross;       ///< Pa, by triangle, zz; empty or NaN: not given
  std::vector<std::uint8_t> held;         ///< Held
  std::vector<std::uint8_t> smoothNodes;  ///< true for boundary nodes on a C¹-smooth part
  std::string name = {};                  ///< unique, without line breaks; may be empty
};

/// Its material, or the bound of several.
[[nodiscard]] inline BodyMaterial wholeOf(const BodySpec& spec) {
  if (!spec.materials.empty()) return boundOf(spec.materials, spec.places);
  BodyMaterial one = spec;
  if (one.plastic.fails()) one.brittle = untilFailure(one.plastic.failure);
  return one;
}

/// Fragments that were removed because they were too small; their energy is in the ledger.
struct Dropped {
  double mass = 0;          ///< kg
  Vec2 momentum = {};       ///< kg m/s, at their removal
  std::uint64_t count = 0;  ///< number of fragments
};

/// A boundary without mass for contact with bodies, which moves by World::rigidVelocities: the
/// outline of an object without elements.
struct RigidSpec {
  TriangleMesh shape;   ///< nodes and loops; triangles inside, for the check of overlaps
  double friction = 0;  ///< coefficient
  std::string name;     ///< for messages
  bool isNew = true;    ///< false: it has contacts already, and may have remaining penetrations
};

class World {
 public:
  /// With or without an axis (Model::axisymmetric), as long as there are no bodies: InputError
  /// otherwise.
  void setAxisymmetric(bool on);
  /// Both throw InputError before anything is changed. With an axis, nodes on it are held in x.
  ComponentId addBody(const TriangleMesh& mesh, const BodySpec& spec);
  void removeBody(ComponentId component);
  /// Throws InputError, before anything is changed, if it overlaps a body.
  ComponentId addRigid(const RigidSpec& spec);
  /// Replaces all rigid boundaries by these. `former`: by index in `rigidNodes` afterwards, the
  /// former index of the corner, `kNoCorner` for a new one; contacts of the side that begins there
  /// are kept. InputError as above: there is then no boundary.
  void replaceRigid(std::span<const RigidSpec> specs, std::span<const std::uint32_t> former);
  static constexpr std::uint32_t kNoCorner = ~std::uint32_t{0};
  /// Nodes of all rigid boundaries, ascending.
  [[nodiscard]] const std::vector<NodeId>& rigidNodes() const { return rigidNodes_; }
  [[nodiscard]] bool hasRigid() const { return !rigidNodes_.empty(); }
  /// Shifts nodes of rigid boundaries along their own lines, which changes only the ends of these:
  /// `places` (m) by index in `rigidNodes`.
  void slideRigid(std::span<const Vec2> places);
  /// Bonds the bodies from the next step on along all their present common sides, by cohesive
  /// cracks of this strength (Pa) and energy (J/m²). Sides with different ends get the same ones
  /// before (fracture/conform.hpp); `done`: by what. Returns the number of these sides. Throws
  /// InputError before anything is changed.
  std::size_t bond(ComponentId a, ComponentId b, double strength, double energy,
                   ConformPlan* done = nullptr);
  /// Bonds all bodies along all sides that are up to `reach` (m) apart. Those that cannot get the
  /// same ends are counted in the result, and not bonded.
  CommonSides bondAll(double reach, double strength, double energy, ConformPlan* done = nullptr);

  /// (N) Constant external forces by node; empty: none. InputError unless one per node, all finite.
  void setLoads(std::vector<Vec2> byNode);
  /// Applies a pressure (Pa, as a function of the simulated time), from now on, to the sides of the
  /// boundary whose two ends are among the nodes, in place of an earlier one; 0: none. It follows
  /// the sides' rotation and the split of nodes. `intoCracks`: it also acts on faces of cracks that
  /// open after this call, as soon as they are connected with sides under this pressure; otherwise
  /// these have none. Throws InputError before anything is changed.
  void setPressure(std::span<const NodeId> nodes, TimeTable value, std::uint32_t function = 0,
                   bool intoCracks = false);
  /// These sides absorb waves from now on.
  void setAbsorbing(std::span<const NodeId> nodes);
  /// From now on the nodes move at `velocity` (m/s) in the directions `held`, and freely in the
  /// others. Throws InputError before anything is changed.
  void prescribe(std::span<const NodeId> nodes, std::uint8_t held, Vec2 velocity);
  /// Prescribes a velocity (m/s) for each of the nodes.
  void prescribeEach(std::span<const NodeId> nodes, std::uint8_t held,
                     std::span<const Vec2> velocity);
  /// Prescribes a motion that begins now; one with a rotation holds both directions.
  void prescribeMotion(std::span<const NodeId> nodes, std::uint8_t held, Motion motion);

  /// One step of Δt (s), which may differ from the previous one. Throws TimeStepError for a step
  /// above the critical one, InputError if it does not resolve a crack's opening, RunError if an
  /// element is inverted or a value is not finite. The state is then unchanged to the last bit: the
  /// next step has the same result as without the refused one.
  void step(double dt);

  /// (s) Of the present mesh; infinite without elements.
  [[nodiscard]] double criticalTimeStep() const;

  /// True if flow has made triangles flatter since the critical step was last computed in a step.
  [[nodiscard]] bool hasFlowed() const { return PlasticFlow::isSteeper(steepness()); }

  /// To save.
  [[nodiscard]] SearchBounds searchBounds() const {
    return isBuilt_ ? search.bounds(dynamics_) : search.loaded;
  }

  /// To save.
  [[nodiscard]] PlasticFlow::Steepness steepness() const {
    return isBuilt_ ? dynamics_.flow().steepness() : loadedSteepness;
  }

  /// (J) At the last half step.
  [[nodiscard]] double kineticEnergy() const { return yadefrag::kineticEnergy(model.nodes); }
  [[nodiscard]] double strainEnergy() const { return yadefrag::strainEnergy(model, lastDt); }
  /// (J) Half of the plastic work in the last motion, which the ledger does not contain yet: the
  /// sum of all energies is that of the half step.
  [[nodiscard]] double pendingPlastic() const { return yieldingEnergy(model, lastDt).dissipated; }
  /// (m/s) By node, at the begin of the last step; work of a force is that with the mean of these
  /// and the present ones. Valid until bodies are added or removed.
  [[nodiscard]] std::span<const Vec2> formerVelocities() const {
    return dynamics_.previousVelocity();
  }

  /// (J) Estimate of the energy that rounding of the coordinates has added to the bodies so far.
  [[nodiscard]] double roundingEnergy() const;

  /// Computes all derived data after loading.
  void rebuild();

  // --- settings
  StepSettings dynamicsSettings;
  ContactSettings contactSettings;
  int threads = 1;
  bool timing = false;  ///< fill `times`
  /// (m/s) By node, for the next step only: of nodes whose motion has a function.
  std::vector<Vec2> givenVelocities;
  /// (m/s) By index in `rigidNodes`, for the next step only; empty: they do not move.
  std::vector<Vec2> rigidVelocities;
  /// Rigid boundaries that obey forces, for the next step only: contact forces change their
  /// velocity in the step. Empty: all have the velocities above.
  RigidMasses rigidMasses;

  // --- state
  Model model;
  ContactSurfaces surfaces;
  Loads loads;
  Contact contact;
  SearchSchedule search;
  Fracture fracture;
  EnergyLedger ledger;
  EnergyWatch watch;
  std::vector<std::string> warnings;  ///< all messages of the watch so far
  Dropped dropped;
  /// (N) Reactions in the last step, by node, in held directions: the force that the prescribed
  /// motion requires, besides weight, loads and all forces of bodies. Not saved; empty before the
  /// first step.
  std::vector<Vec2> reactions;
  std::uint64_t steps = 0;
  double time = 0;    ///< s
  double lastDt = 0;  ///< s
  /// (s) The longest step found stable since bodies were added or removed, with this viscosity.
  double stableStep = 0;
  BulkViscosity stableViscosity;
  PlasticFlow::Steepness loadedSteepness;  ///< that of `stableStep`; taken over at the next step

  // --- counters
  StageTimes times;
  [[nodiscard]] std::uint64_t numSearches() const { return search.count; }

 private:
  [[nodiscard]] TriangleMesh besideAxis(TriangleMesh mesh, const BodySpec& spec) const;
  void holdOnAxis(NodeId first);
  void requireOutsideAxis() const;
  void absorb(const StepLength& length);
  void requireNodes(std::span<const NodeId> nodes) const;
  void removeUnusedMotions();
  void drive(double dt);
  void undoDrive();
  void noteChange();
  void buildIfChanged();
  void requireStableStep(double dt);
  void updateStressLimits();
  void advance(double dt);
  void beginUndo();
  void undo();
  void conclude(double dt);
  void requireBody(ComponentId component, const char* purpose) const;
  CommonSides conformedSides(std::span<const ComponentId> bodies, double reach,
                             const std::function<void(const CommonSides&)>& check,
                             ConformPlan* done);
  void onDivision(const DividedSides& divided);
  void bond(const CommonSides& sides, double strength, double energy);
  void requireApart(const TriangleMesh& mesh, const BodySpec& spec, const std::string& subject);
  [[nodiscard]] Vec2 rigidVelocity(NodeId node) const;
  std::uint32_t rigidMotion();
  std::vector<EntryId> takeOff(const std::vector<std::uint8_t>& gone,
                               std::span<const NodeId> renumbered);
  ComponentId appendRigid(const RigidSpec& spec);
  std::vector<EntryId> removeAllRigid();
  [[nodiscard]] std::vector<std::uint32_t> rigidEntries() const;
  void requireBoundedMotion(double dt);
  void requireResolvedMotion(double dt);
  void requireFiniteEnergy() const;
  void correctContact(const StepLength& length);
  void countContactWork(const StepLength& length);
  void applyCohesion(const StepLength& length);
  void countFractureWork(const StepLength& length);
  void watchEnergy();
  [[nodiscard]] double overlapOfBoundaries() const;
  [[nodiscard]] double energyOf(ComponentId body, NodeId first, double dt) const;
  bool crack();
  void dropFragments(bool split);
  void remove(std::span<const ElementId> triangles);
  void openJoints(std::span<const EdgeId> joints);
  void onSplit();
  void measureFinest();
  [[nodiscard]] bool canTouch() const;
  [[nodiscard]] SearchSchedule::Scene searchScene();
  void predict(const StepLength& length);
  void requireUpright(double dt);
  void finish(const StepLength& length);
  void measureReactions(const StepLength& length);
  [[nodiscard]] StageTimes* timesIfRequested() { return timing ? &times : nullptr; }

  ExplicitDynamics dynamics_;
  SplitResult split_;
  LooseFragments loose_;
  BodyPlaces places_;
  std::vector<NodeId> rigidNodes_;
  std::vector<Vec2> surfaceForces_;  // N, by node, of contact and cohesion
  std::span<const Vec2> pushes_;     // N, the same or those of contact only, in the present step
  bool isBuilt_ =
      false;  // do the arrays below fit the model: many bodies join, then one step comes
  bool severalBodies_ = false;
  StepUndo undo_;
  double ofChange_ = 0;  // J, see EnergyWatch::addOfChange
  double finest_ = 0;    // m, shortest stress-free segment: independent of the time of the search
  double droppedBelow_ = 0;  // m², no detached fragment is smaller; 0: unknown
  std::string broken_;       // reason why the state is invalid; empty: it is valid
};

/// Throws InputError, which states the invalid value and the valid range, unless every value is
/// valid: finite, with the correct sign, one for each node of the mesh, and no triangle with a mass
/// or stiffness out of range (body_check.cpp).
void checkBody(const TriangleMesh& mesh, const BodySpec& spec, bool axisymmetric);

/// Returns an empty string if every array has its length, every index is in range, every list is
/// consistently linked, and every divisor is positive and finite; otherwise the invalid part. For
/// states from files (state_check.cpp).
[[nodiscard]] std::string findInvalidPart(const World& world);

}  // namespace yadefrag
