#pragma once
// The engine for finite-element bodies.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "bodies/entry_bodies.hpp"
#include "bodies/rigid_bodies.hpp"
#include "bodies/sphere_contacts.hpp"
#include "materials/materials.hpp"
#include "solver/scene_energy.hpp"
#include "solver/scene_watch.hpp"
#include "step/world.hpp"
#include "yade/published.hpp"
#include "yade/step_lock.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

// --- What pkg/script adds to Python: each function is defined in the file of its subject.

class FESolver;
using SolverClass = yade::py::class_<FESolver, boost::shared_ptr<FESolver>,
                                     yade::py::bases<yade::GlobalEngine>, boost::noncopyable>;

// In the module _yadefrag.
void defineBodyParts();
void defineMeshes();

// In FESolver; addPolygon and others are written in Python (python/yadefrag/fe/solver.py).
void defineArrays(SolverClass& solver);
void defineBodies(SolverClass& solver);
void defineMotions(SolverClass& solver);
void defineQuality(SolverClass& solver);
void defineResults(SolverClass& solver);

/// Functions of a script that the steps call. They are Python objects, and are not saved to files.
class ScriptFunctions {
 public:
  ScriptFunctions() = default;
  ~ScriptFunctions();
  ScriptFunctions(const ScriptFunctions&) = delete;
  ScriptFunctions& operator=(const ScriptFunctions&) = delete;

  /// Returns the function's number, which is never 0. Requires Python's lock, as `keep` does.
  std::uint32_t add(const yade::py::object& function);
  /// Removes functions that are not used in the world.
  void keep(const World& world);

  /// Calls the functions of motions and pressures for the next step of `dt` (s): (array of the
  /// nodes' positions, middle of the step in s) → array of velocities (m/s); time (s) → Pa. Does
  /// nothing if there are none or one is missing. Throws std::runtime_error with the message of a
  /// function's exception.
  void giveValues(World& world, double dt) const;

 private:
  void giveVelocities(World& world, double dt) const;
  void givePressures(World& world) const;

  std::map<std::uint32_t, yade::py::object> functions_;
};

struct AddedBody {
  int component;
  std::string message;  ///< on a mesh that does not resolve the cohesive zone; or empty
};

/// Attributes of FESolver that have limits.
struct FESettings {
  int passes = 1;
  ToleranceChoice contactTolerance;
  double halo = ContactSettings().halo;
  double damping = 0;
  yade::Vector3r gravity = yade::Vector3r::Zero();
  double linearViscosity = 0;
  double quadraticViscosity = 0;
  int maxCracks = -1;
  double minFragmentArea = 0;
  std::string view = "component";
  bool axisymmetric = false;

  /// Throws std::invalid_argument.
  void check() const;
};

class FESolver final : public Published<FESolver, yade::GlobalEngine> {
 public:
  static constexpr const char* kName = "FESolver";
  static constexpr const char* kDoc =
      "Finite-element bodies in the plane z = 0: explicit dynamics, and contact without "
      "interpenetration between them. Its place in O.engines is after the collider and the "
      "InteractionLoop and before NewtonIntegrator. Raises ValueError for a time step above "
      "criticalTimeStep(), RuntimeError naming the element or node if a run cannot continue.";

  void action() override;
  void postLoad(FESolver& self);

  /// Adds a body, and the bodies of its entries to the scene of `O`. Throws InputError before
  /// anything is changed. `materials`: one, or those to whose numbers `spec.materials.ofTriangle`
  /// refers.
  AddedBody addBody(const TriangleMesh& mesh, BodySpec spec,
                    const std::vector<yade::shared_ptr<FEMat>>& materials);
  void removeBody(int component);
  /// Runs `work`, which bonds bodies of the world; `done` of its result (a ConformPlan) tells what
  /// it changed on the boundary, which the scene's bodies then follow.
  template <class Work>
  auto bond(const Work& work);

  [[nodiscard]] double criticalTimeStep();
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] World& changeWorld() { return world_; }
  [[nodiscard]] const EntryBodies& entryBodies() const { return bodies_; }
  /// (N) Of contact, by node, in the last step; empty before the first contact.
  [[nodiscard]] std::span<const Vec2> contactForces() const {
    return loadedForces_.empty() ? world_.contact.forces().known : loadedForces_;
  }
  /// Adds a message that has been written already.
  void note(std::string sentence) { world_.warnings.push_back(std::move(sentence)); }
  [[nodiscard]] const SceneEnergy& balance() const { return balance_; }
  [[nodiscard]] ScriptFunctions& scriptFunctions() { return functions_; }
  /// Locked during each step, and during each read and change from Python.
  [[nodiscard]] StepLock& betweenSteps() const { return betweenSteps_; }

  FESettings settings;
  bool takesGravity = true;
  bool rigidBodies = true;

  static Attributes attributes();
  static void pyExtra(SolverClass& solver) {
    defineArrays(solver), defineBodies(solver), defineMotions(solver);
    defineQuality(solver), defineResults(solver);
  }
  void archiveMore(AnyArchive& archive);

 private:
  void followScene();
  void stepWorld();
  void requireAlone(const yade::Scene& here) const;
  void giveSettings();
  void checkBodies();
  void collectForces();
  void followFlow();
  void reportFlowStep();
  bool tryStep(double given);
  void warn(std::size_t known) const;
  void checkScene(bool enginesAreNew);
  [[nodiscard]] std::string overlapWithSphere(std::size_t first) const;
  void checkTimeStep();
  void followRigid(bool enginesAreNew);
  void report(std::vector<std::string> sentences);
  [[nodiscard]] yade::NewtonIntegrator* integrator(bool behind) const;
  void takeGravity(const yade::NewtonIntegrator* newton);
  void followCracks(std::uint64_t dropped);
  void followBonds();
  void updateBodies();
  void trackEnergy() const;

  World world_;
  std::vector<Vec2> loadedForces_;  // of contact, of a saved state, until the next step
  EntryBodies bodies_;
  EngineOrder order_;
  SceneWatch around_;
  MaterialWatch materials_;
  RigidBodies rigid_;
  ContactReactions given_;
  SceneEnergy balance_;
  RollingSpheres rolling_;
  CrackContacts crackContacts_;
  bool checkedRigid_ = true;  // `rigidBodies` when the scene was last checked
  // Both gravities when they were last compared.
  yade::Vector3r comparedGravity_ = yade::Vector3r::Zero(), comparedNewton_ = comparedGravity_;
  ScriptFunctions functions_;
  FESettings former_;  // the last ones within their limits
  mutable StepLock betweenSteps_;
};

template <class Work>
auto FESolver::bond(const Work& work) {
  if (!bodies_.ids().empty()) bodies_.requireAll(*yade::Omega::instance().getScene());
  auto result = work(changeWorld());
  if (!result.done.isEmpty()) followBonds();
  return result;
}

}  // namespace yadefrag
