#pragma once
// All state of the finite-element bodies of a scene, and the step that moves them (time_step.cpp).

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "contact/pass_rule.hpp"
#include "core/stage_times.hpp"
#include "dynamics/energy_ledger.hpp"
#include "dynamics/explicit_dynamics.hpp"
#include "dynamics/surface_loads.hpp"
#include "fracture/fracture.hpp"
#include "fracture/loose_pieces.hpp"
#include "mesh/model.hpp"
#include "mesh/triangle_mesh.hpp"
#include "search/contact_search.hpp"
#include "step/apart_bodies.hpp"
#include "step/body_places.hpp"
#include "step/energy_watch.hpp"
#include "step/halo_watch.hpp"
#include "step/step_undo.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// What a body is beside its mesh. Arrays are by node of the mesh; empty ones stand for zeros.
struct BodySpec : BodyMaterial {
  MaterialPlaces materials;  ///< in place of the one above, if there are several
  BrittlePlaces places;
  double thickness = 1;  ///< m
  bool selfContact = true;
  bool rigid = false;  ///< only to see what it overlaps
  ElementKind element = ElementKind::kLinear;
  std::vector<Vec2> velocity;      ///< m/s
  std::vector<Vec2> displacement;  ///< m, from the stress-free shape
  /// Pa (Cauchy; xx, yy, xy), by triangle, in the shape of the mesh; empty: none.
  std::vector<std::array<double, 3>> stress;
  std::vector<std::uint8_t> held;         ///< Held
  std::vector<std::uint8_t> smoothNodes;  ///< is a boundary node on a C¹-smooth part
  std::string name = {};  ///< one that no other body has, without line breaks; may be empty
};

/// Its material, or the bound of several.
[[nodiscard]] inline BodyMaterial wholeOf(const BodySpec& spec) {
  if (spec.materials.empty()) return spec;
  return boundOf(spec.materials, spec.places);
}

/// Fragments that were taken out because they were too small; their energy is in the ledger.
struct Dropped {
  double mass = 0;          ///< kg
  Vec2 momentum = {};       ///< kg m/s, when they went
  std::uint64_t count = 0;  ///< fragments
};

/// A boundary without mass that touches bodies, and moves as World::rigidVelocities says: the
/// outline of something that is not made of elements.
struct RigidSpec {
  TriangleMesh shape;   ///< nodes and loops; triangles where it is solid, to see what overlaps it
  double friction = 0;  ///< coefficient
  std::string name;     ///< for sentences
  bool isNew = true;    ///< false: it touches bodies already, and may be in them by what is left
};

class World {
 public:
  /// Both throw InputError before anything is changed.
  ComponentId addBody(const TriangleMesh& mesh, const BodySpec& spec);
  void removeBody(ComponentId component);
  /// InputError before anything is changed where it overlaps a body.
  ComponentId addRigid(const RigidSpec& spec);
  /// Takes all rigid boundaries out and these in. `former`: by place in `rigidNodes` after that,
  /// the place before of the corner that it stands for, `kNoCorner` for a new one; what touched the
  /// side that begins there still does. InputError as above: there is no boundary then.
  void replaceRigid(std::span<const RigidSpec> specs, std::span<const std::uint32_t> former);
  static constexpr std::uint32_t kNoCorner = ~std::uint32_t{0};
  /// Of all rigid boundaries, ascending.
  [[nodiscard]] const std::vector<NodeId>& rigidNodes() const { return rigidNodes_; }
  [[nodiscard]] bool hasRigid() const { return !rigidNodes_.empty(); }
  /// Shifts nodes of rigid boundaries along their own lines, which changes nothing but where these
  /// end: `places` (m) by place in `rigidNodes`.
  void slideRigid(std::span<const Vec2> places);
  /// From the next step on the bodies hang together along all sides that they have in common now,
  /// as a crack that holds does, of this strength (Pa) and energy (J/m²). Returns how many sides
  /// these are. InputError before anything is changed.
  std::size_t bond(ComponentId a, ComponentId b, double strength, double energy);

  /// (N) Constant outer forces by node; empty: none. InputError unless one per node, all finite.
  void setLoads(std::vector<Vec2> loads);
  /// From now on a pressure (Pa, over the simulated time) acts on the sides of the boundary that
  /// have both ends among the nodes, in place of an earlier one; 0: none. It follows them as they
  /// turn, and as nodes split. `intoCracks`: it comes to faces of cracks that open after this call,
  /// as soon as they hang together with sides that have it; else these have none. InputError before
  /// anything is changed.
  void setPressure(std::span<const NodeId> nodes, TimeTable value, std::uint32_t function = 0,
                   bool intoCracks = false);
  /// From now on waves leave by these sides.
  void setAbsorbing(std::span<const NodeId> nodes);
  /// From now on the nodes move at `velocity` (m/s) in the directions `held`, and freely in the
  /// others. InputError before anything is changed.
  void prescribe(std::span<const NodeId> nodes, std::uint8_t held, Vec2 velocity);
  /// The same with a velocity for each of the nodes.
  void prescribeEach(std::span<const NodeId> nodes, std::uint8_t held,
                     std::span<const Vec2> velocity);
  /// The same as a motion, which begins now, has it; one that turns holds both directions.
  void prescribeMotion(std::span<const NodeId> nodes, std::uint8_t held, Motion motion);

  /// One step of Δt (s), which may differ from the last one's. Throws TimeStepError for a step
  /// above the critical one, InputError where it does not resolve a crack's opening, RunError where
  /// an element or a value gives out. All state is then as it was before, to the last bit: the next
  /// step is what it would have been.
  void step(double dt);

  /// (s) From the present mesh; infinite without elements.
  [[nodiscard]] double criticalTimeStep() const;

  /// Half the halo around an entry's piece, for a search from outside (a collider). To be asked
  /// before that search, if one is due: the halo's width follows the velocities.
  [[nodiscard]] Box boxOf(EntryId entry) const;
  /// `first`: the segments before it are where, and as fast as, they were at the last call.
  void chooseHalo(double dt, SegmentId first = SegmentId(0));
  /// Takes pairs of entries whose boxes overlap at the present positions in place of the world's
  /// own search.
  void takePairs(std::span<const BoxPair> overlapping);

  /// (J) At the last half step.
  [[nodiscard]] double kineticEnergy() const { return yadefrag::kineticEnergy(model.nodes); }
  [[nodiscard]] double strainEnergy() const { return yadefrag::strainEnergy(model, lastDt); }

  /// (J) What rounding of the coordinates has made of the bodies' energy so far, or less.
  [[nodiscard]] double roundingEnergy() const;

  /// What all arrays are for, and how long they are.
  [[nodiscard]] Footprint footprint() const;

  /// What does not follow from the saved state, after it has been loaded.
  void rebuild();

  // --- settings
  StepSettings dynamicsSettings;
  ContactSettings contactSettings;
  int threads = 1;
  bool timing = false;  ///< fill `times`
  /// (N) By node, for the next step only; empty: none.
  std::vector<Vec2> outerForces;
  /// (m/s) By node, for the next step only: of nodes whose motion has a function.
  std::vector<Vec2> givenVelocities;
  /// (m/s) By place in `rigidNodes`, for the next step only; empty: they stand still.
  std::vector<Vec2> rigidVelocities;
  /// Of pressures that have a function, for the next step only.
  struct GivenPressure {
    std::uint32_t function;
    double value;  ///< Pa
  };
  std::vector<GivenPressure> givenPressures;

  // --- state
  Model model;
  ContactSurfaces surfaces;
  std::vector<Pressure> pressures;
  AbsorbingBoundary absorbing;
  Contact contact;
  HaloWatch search;
  Fracture fracture;
  EnergyLedger ledger;
  EnergyWatch watch;
  std::vector<std::string> complaints;  ///< of the watch, all so far
  Dropped dropped;
  std::vector<Vec2> reference;  ///< m, stress-free positions by node
  /// (N) Of the last step, by node, in held directions: what the node needs to move as it does,
  /// over its weight, loads and all forces of bodies. Not saved; empty before the first step.
  std::vector<Vec2> reactions;
  std::uint64_t steps = 0;
  double time = 0;    ///< s
  double lastDt = 0;  ///< s
  /// (s) The longest step that has been found stable since bodies came or went, with this
  /// viscosity.
  double stableStep = 0;
  BulkViscosity stableViscosity;

  // --- counters
  std::uint64_t numSearches = 0;
  StageTimes times;
  [[nodiscard]] std::span<const NodeId> surfaceNodes() const { return search.nodes; }

 private:
  [[nodiscard]] std::vector<SegmentId> segmentsAmong(std::span<const NodeId> nodes) const;
  void forgetUnusedPressures();
  void spreadPressures();
  void takeLoadsOff(const std::vector<std::uint8_t>& gone);
  void sumOuterForces();
  [[nodiscard]] const std::vector<Vec2>& allOuterForces() const {
    return pressures.empty() ? outerForces : allOuterForces_;
  }
  void absorb(const StepLength& length);
  void requireNodes(std::span<const NodeId> nodes) const;
  void forgetUnusedMotions();
  void drive(double dt);
  void letDrivenGo();
  void buildIfChanged();
  void requireStableStep(double dt);
  void watchStrengths();
  void advance(double dt);
  void beginUndo();
  void takeBack();
  void conclude(double dt);
  void requireBody(ComponentId component, const char* purpose) const;
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
  void bookContact(const StepLength& length);
  void cohere(const StepLength& length);
  void bookFracture(const StepLength& length);
  void watchEnergy();
  [[nodiscard]] double energyOf(ComponentId body, NodeId first, double dt) const;
  bool crack();
  void dropFragments(bool split);
  void takeOut(std::span<const ElementId> triangles);
  void openJoints(std::span<const EdgeId> joints);
  void followSplit();
  [[nodiscard]] double finestSegment() const;
  [[nodiscard]] bool canTouch() const;
  [[nodiscard]] HaloWatch::Scene searchScene();
  void predict(const StepLength& length);
  void requireUpright(double dt);
  void finish(const StepLength& length);
  void measureReactions(const StepLength& length);
  [[nodiscard]] StageTimes* timesIfAsked() { return timing ? &times : nullptr; }

  ExplicitDynamics dynamics_;
  SplitResult split_;
  LoosePieces loose_;
  BodyPlaces places_;
  std::vector<NodeId> rigidNodes_;
  std::vector<Vec2> allOuterForces_;  // N, by node, with pressures; empty without any
  std::vector<Vec2> surfaceForces_;   // N, by node, of contact and cohesion
  std::span<const Vec2> pushes_;      // N, the same or those of contact alone, of the present step
  bool isBuilt_ =
      false;  // do the arrays below fit the model: many bodies join, then one step comes
  bool severalBodies_ = false;
  StepUndo undo_;
  double finest_ = 0;  // m, shortest stress-free segment: does not depend on the time of the search
  double droppedBelow_ = 0;  // m², no loose fragment is smaller; 0: unknown
  std::string broken_;       // why there is no state to go on with; empty: there is
};

}  // namespace yadefrag
