#pragma once
// The engine for finite-element bodies.

#include <string>
#include <tuple>
#include <vector>

#include "abi/yade.hpp"
#include "entries/crack_contacts.hpp"
#include "entries/entry_bodies.hpp"
#include "entries/rolling.hpp"
#include "fe/engine_order.hpp"
#include "fe/fe_archive.hpp"
#include "fe/material_watch.hpp"
#include "fe/materials.hpp"
#include "fe/scene_energy.hpp"
#include "fe/scene_watch.hpp"
#include "fe/step_lock.hpp"
#include "publish/published.hpp"
#include "rigid/rigid_bodies.hpp"
#include "script/definitions.hpp"
#include "script/script_functions.hpp"
#include "step/world.hpp"

namespace yadefrag {

struct AddedBody {
  int component;
  std::string message;  ///< on a mesh that does not resolve the cohesive zone; or empty
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
  /// Adds a message that has been written already.
  void note(std::string sentence) { world_.warnings.push_back(std::move(sentence)); }
  [[nodiscard]] const SceneEnergy& balance() const { return balance_; }
  [[nodiscard]] ScriptFunctions& scriptFunctions() { return functions_; }
  /// Locked during each step, and during each read and change from Python.
  [[nodiscard]] StepLock& betweenSteps() const { return betweenSteps_; }

  std::string correction = "lagrange";
  std::string entry = "path";
  int passes = 1;
  static constexpr double kPenaltyFactor = .2;  // of earlier versions
  double penaltyFactor = kPenaltyFactor;
  double halo = ContactSettings().halo;
  double damping = 0;
  yade::Vector3r gravity = yade::Vector3r::Zero();
  bool takesGravity = true;
  double linearViscosity = 0;
  double quadraticViscosity = 0;
  int maxCracks = -1;
  double minFragmentArea = 0;
  double energyFromSpheres = 0;
  bool rigidBodies = true;
  std::string view = "component";

  static constexpr auto contactAttributes();
  static constexpr auto attributes();
  static void pyExtra(SolverClass& solver) {
    defineArrays(solver), defineBodies(solver), defineMotions(solver);
    defineQuality(solver), defineResults(solver);
  }
  template <class Archive>
  void archiveMore(Archive& archive);

 private:
  void requireAlone(const yade::Scene& here) const;
  void checkSettings() const;
  [[nodiscard]] std::vector<std::string> unusedSettings() const;
  void giveSettings();
  void checkBodies();
  void collectForces();
  void followFlow();
  void warn(std::size_t known) const;
  void checkScene(bool enginesAreNew);
  void checkTimeStep();
  void followRigid(bool enginesAreNew);
  void report(std::vector<std::string> sentences);
  [[nodiscard]] yade::NewtonIntegrator* integrator(bool behind) const;
  [[nodiscard]] bool takesOver() const { return takesGravity && gravity.isZero(0); }
  void followCracks(std::uint64_t dropped);
  void followBonds();
  void updateBodies();
  void trackEnergy() const;
  [[nodiscard]] int threadsToUse() const;

  World world_;
  EntryBodies bodies_;
  EngineOrder order_;
  SceneWatch around_;
  MaterialWatch materials_;
  RigidBodies rigid_;
  GivenForces given_;
  SceneEnergy balance_;
  RollingSpheres rolling_;
  CrackContacts crackContacts_;
  bool checkedRigid_ = true;  // `rigidBodies` when the scene was last checked
  ScriptFunctions functions_;
  yade::Vector3r formerGravity_ = yade::Vector3r::Zero();  // value of `gravity` before it was set
  // Of settings that only this class has, likewise.
  std::string formerView_ = view, formerCorrection_ = correction, formerEntry_ = entry;
  double formerPenaltyFactor_ = penaltyFactor;
  mutable StepLock betweenSteps_;
};

template <class Work>
auto FESolver::bond(const Work& work) {
  if (!bodies_.ids().empty()) bodies_.requireAll(*yade::Omega::instance().getScene());
  auto result = work(changeWorld());
  if (!result.done.isEmpty()) followBonds();
  return result;
}

constexpr auto FESolver::contactAttributes() {
  using C = FESolver;
  using yade::Attr::triggerPostLoad;
  return std::tuple(
      attribute("correction", &C::correction,
                "'lagrange': contact by forces that just prevent interpenetration. 'penalty' is "
                "accepted for scripts of earlier versions, and has no effect.",
                triggerPostLoad),
      attribute("entry", &C::entry,
                "'path': a point becomes active on a surface that its path in the step crosses. "
                "'flags' is accepted for scripts of earlier versions, and has no effect.",
                triggerPostLoad),
      attribute("passes", &C::passes,
                "1: of two surfaces the points of the finer one and the sharp corners of the other "
                "must not "
                "penetrate; 2: the points of both. Where a body can crack, it is 2 in any case.",
                triggerPostLoad),
      attribute("penaltyFactor", &C::penaltyFactor,
                "Accepted for scripts of earlier versions, above 0 and at most 1; no effect.",
                triggerPostLoad),
      attribute(
          "halo", &C::halo,
          "Width of the strip around a boundary in which contact is expected, relative to the "
          "shortest segment, at most 0.5; 0: as wide as the bodies' speed requires. Results "
          "do not depend on it, but the number of searches does.",
          triggerPostLoad));
}

constexpr auto FESolver::attributes() {
  using C = FESolver;
  using yade::Attr::triggerPostLoad;
  constexpr auto others = std::tuple(
      attribute("damping", &C::damping, "Mass-proportional damping (1/s).", triggerPostLoad),
      attribute("gravity", &C::gravity,
                "Acceleration of all bodies of this engine (m/s²), a pair, or three numbers with "
                "z = 0. Until it is set, that of a NewtonIntegrator in O.engines is used.",
                triggerPostLoad),
      attribute("takesGravity", &C::takesGravity,
                "As long as `gravity` is zero, use x and y of NewtonIntegrator's gravity. "
                "Setting `gravity` sets this to False; setting this to True undoes that."),
      attribute("linearViscosity", &C::linearViscosity,
                "Coefficient of the linear bulk viscosity; 0: none, .06 is usual.",
                triggerPostLoad),
      attribute("quadraticViscosity", &C::quadraticViscosity,
                "Coefficient of the quadratic bulk viscosity, in compression; 0: none, 1.2 is "
                "usual.",
                triggerPostLoad),
      attribute("maxCracks", &C::maxCracks,
                "Maximum total number of edges that crack; -1: no limit.", triggerPostLoad),
      attribute("minFragmentArea", &C::minFragmentArea,
                "Detached fragments with a smaller area (m², stress-free) are removed from "
                "the scene, and counted in `dropped`, except held ones. 0: none is removed.",
                triggerPostLoad),
      attribute("energyFromSpheres", &C::energyFromSpheres,
                "0, for scripts of earlier versions: contacts with faces of cracks begin without a "
                "force, in any "
                "order of O.engines.",
                yade::Attr::readonly),
      attribute("rigidBodies", &C::rigidBodies,
                "Contact with YADE's Wall, Box and Facet, also in clumps: their sections "
                "with the plane z = 0, rigid, with the friction of their FrictMat. They move as "
                "YADE moves them, and get the forces of contact (O.forces.f, O.forces.t)."),
      attribute("view", &C::view,
                "Meaning of the bodies' colours in YADE's 3D view: 'component', 'fragment', or "
                "'mises', from blue at 0 to red at the largest.",
                triggerPostLoad));
  return std::tuple_cat(contactAttributes(), others);
}

template <class Archive>
void FESolver::archiveMore(Archive& archive) {
  std::vector<yade::Body::id_t> ids = bodies_.ids();
  WorldArchive<Archive>(archive).run(world_, ids);
  rigid_.archive(archive, world_);
  rolling_.archive(archive);
  crackContacts_.archive(archive);
  balance_.archive(archive);
  if constexpr (Archive::is_loading::value) bodies_.restore(std::move(ids));
}

}  // namespace yadefrag
