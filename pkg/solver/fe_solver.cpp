#include "solver/fe_solver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "bodies/sphere_overlap.hpp"
#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/spheres.hpp"
#include "core/tolerances/step.hpp"
#include "loop/curve_integrator.hpp"
#include "yade/running.hpp"

namespace yadefrag {

namespace {

/// A sentence if an engine sets O.dt; YADE's know nothing of FE bodies.
std::string byTimeStepper(const yade::Scene& scene) {
  for (const auto& engine : scene.engines)
    if (!engine->dead && engine->getBaseClassName() == "TimeStepper")
      return fmt::format(
          " {} sets O.dt without FE bodies; give it maxDt = .8 * fe.criticalTimeStep(), or remove "
          "it and set O.dt.",
          engine->getClassName());
  return {};
}

}  // namespace

/// One step: from the forces of spheres and other engines on the boundary in this step to the new
/// position of the boundary.
void FESolver::action() try {
  const std::lock_guard guard(betweenSteps_);
  given_.begin(*scene);
  if (bodies_.ids().empty()) return;
  followScene();
  const std::uint64_t dropped = world_.dropped.count, searches = world_.numSearches();
  const double lastDt = world_.lastDt;

  // From YADE's bodies: forces on nodes, motion of rigid boundaries.
  collectForces();
  functions_.giveValues(world_, scene->dt);
  rigid_.giveVelocities(*scene, world_, integrator(true));
  balance_.begin(*scene, world_, bodies_,
                 {integrator(false) != nullptr, order_.spheresMoveFirst()});

  stepWorld();

  // To YADE's bodies: forces on rigid ones, then new faces, places and velocities of the pieces.
  if (rigid_.any()) {
    rigid_.giveForces(*scene, world_, {scene->dt, lastDt}, given_);
    rigid_.warnOfArcs(world_);
    report(rigid_.takeSentences());
  }
  balance_.end(*scene, world_, given_);
  report({balance_.takeDeep(), balance_.message(world_)});
  followCracks(dropped);
  given_.end(*scene);
  updateBodies();
  // A search renews the halo, and with it the margin of the bounds.
  if (world_.numSearches() != searches && bodies_.meetOthers(*scene)) scene->doSort = true;
  if (scene->trackEnergy) trackEnergy();
} catch (const std::exception& error) {
  noteStop(error.what());
  throw;
}

/// What a script or another engine has changed since the last step.
void FESolver::followScene() {
  if (scene->isPeriodic)
    throw std::invalid_argument("FESolver: the scene is periodic, but FE bodies cannot be.");
  const bool enginesAreNew = order_.require(*scene, *this);
  bodies_.requireAll(*scene);
  giveSettings();
  followFlow();
  checkScene(enginesAreNew);
  followRigid(enginesAreNew);
  if (world_.search.isDue()) checkBodies();
}

void FESolver::stepWorld() {
  const std::size_t known = world_.warnings.size();
  const double given = scene->dt;
  try {
    for (bool isDone = false; !isDone;) isDone = tryStep(given);
  } catch (const TimeStepError& error) {
    throw std::invalid_argument("O.dt: " + std::string(error.what()) + byTimeStepper(*scene));
  } catch (const InputError& error) {
    throw std::invalid_argument(error.what());
  }
  loadedForces_.clear();
  warn(known);
}

/// False if O.dt was reduced: where bodies yield, flow presses triangles flat until their own
/// stiffness stops them. `given` (s): O.dt before.
bool FESolver::tryStep(double given) try {
  world_.step(scene->dt);
  return true;
} catch (const FlatError& error) {
  const bool isPlastic = world_.model.triangles.plastic.isUsed();
  if (!isPlastic || !(error.advised > tolerance::kLeastFlowStep * given)) throw;
  scene->dt = std::min(error.advised, tolerance::kFlowStep * scene->dt);
  reportFlowStep();
  return false;
}

/// Reduces O.dt if plastic flow has made triangles so flat that it is above the critical step.
void FESolver::followFlow() {
  if (!world_.hasFlowed()) return;
  const double critical = world_.criticalTimeStep();
  if (scene->dt <= critical) return;
  scene->dt = tolerance::kFlowStep * critical;
  reportFlowStep();
}

void FESolver::reportFlowStep() {
  report(
      {"O.dt is reduced to 0.8 of the critical step where plastic flow makes triangles flatter "
       "(docs/materials.md)."});
}

/// Of the surface pieces, which a script can change.
void FESolver::checkBodies() {
  bodies_.requireWhole();
  if (bodies_.haveExcludingMasks())
    report(
        {"Masks of FE bodies exclude interactions between them, but have no effect on contact of "
         "FE bodies with each other; they have with spheres and other bodies of YADE."});
}

/// Of spheres and other bodies on the boundary.
void FESolver::collectForces() {
  bodies_.collectForces(*scene, world_, world_.loads.outerForces);
  if (world_.loads.outerForces.empty()) return rolling_.clear();
  // The forces must stay the same on both sides of each contact.
  if (rolling_.carry(*scene, bodies_, world_.surfaces, order_.spheresMoveFirst()))
    bodies_.collectForces(*scene, world_, world_.loads.outerForces);
}

/// Writes the new warnings.
void FESolver::warn(std::size_t known) const {
  for (std::size_t i = known; i < world_.warnings.size(); ++i)
    std::cerr << "WARN  FESolver: " << world_.warnings[i] << std::endl;
}

/// Takes over the gravity of the scene, or reports that spheres have another one.
void FESolver::takeGravity(const yade::NewtonIntegrator* newton) {
  const yade::Vector3r& gravity = settings.gravity;
  const yade::Vector3r theirs = newton ? newton->gravity : yade::Vector3r::Zero();
  if (takesGravity) {
    // One that is not finite is no setting; the step refuses it.
    world_.dynamicsSettings.gravity = {theirs[0], theirs[1]};
    const yade::Vector3r taken(theirs[0], theirs[1], 0);
    if (taken.allFinite() && taken != gravity) settings.gravity = former_.gravity = taken;
    return;
  }
  if (!newton || (gravity == comparedGravity_ && theirs == comparedNewton_)) return;
  if (around_.free() < 0) return;
  comparedGravity_ = gravity, comparedNewton_ = theirs;
  if (theirs[0] == gravity[0] && theirs[1] == gravity[1]) return;
  report({fmt::format(
      "The gravity of FE bodies is ({:g}, {:g}) m/s², that of YADE's bodies, such as #{}, ({:g}, "
      "{:g}) m/s²; with fe.takesGravity = True all have that of NewtonIntegrator.",
      gravity[0], gravity[1], around_.free(), theirs[0], theirs[1])});
}

/// Takes over the gravity of the scene, and reports contacts and forces that the bodies will not
/// have.
void FESolver::checkScene(bool enginesAreNew) {
  const yade::NewtonIntegrator* newton = integrator(false);
  const std::size_t first = around_.checked();
  const bool bodiesAreNew = around_.check(*scene);
  takeGravity(newton);
  if (settings.axisymmetric) {
    around_.requireRound();
    settings.check();
  }
  if (around_.hasNewSpheres()) report({overlapWithSphere(first)});
  const bool rigidChanged = std::exchange(checkedRigid_, rigidBodies) != rigidBodies;
  report(materials_.sentences());
  if (world_.steps == 0) checkTimeStep();
  if (!bodiesAreNew && !enginesAreNew && !rigidChanged) return;
  double thickest = 0;
  for (const Component& body : world_.model.components)
    if (!body.rigid) thickest = std::max(thickest, body.thickness);
  const yade::Vector3r pull = newton ? newton->gravity : yade::Vector3r::Zero();
  report(around_.sentences(pull, rigidBodies, thickest));
}

/// YADE's default is much shorter than the step of most bodies; the run would only seem to stand.
void FESolver::checkTimeStep() {
  if (scene->dt != tolerance::kDefaultStep) return;
  const double critical = world_.criticalTimeStep();
  if (scene->dt > tolerance::kShortStep * critical) return;
  report({fmt::format(
      "O.dt has YADE's default, {:g} s, {:.3g} times shorter than the critical step, {:.3g} s; "
      "O.dt = .8 * fe.criticalTimeStep() is usual.",
      scene->dt, critical / scene->dt, critical)});
}

/// The sentence on the spheres that were added since the scene was last checked, from number
/// `first` on. Contacts of a loaded scene may be deeper.
std::string FESolver::overlapWithSphere(std::size_t first) const {
  std::vector<std::array<Vec2, 3>> triangles;
  const auto& model = world_.model;
  for (std::size_t e = 0; e < model.triangles.size(); ++e) {
    if (model.triangles.isDropped(e)) continue;
    const auto& [a, b, c] = model.triangles.nodes[e];
    const auto& at = model.nodes.position;
    triangles.push_back({at[a.value], at[b.value], at[c.value]});
  }
  const bool isLoaded = first == 0 && world_.steps > 0;
  const auto found = deepestOverlap(*scene, first, bodies_.firstBody()->groupMask, triangles,
                                    isLoaded ? tolerance::kDeepSphere : tolerance::kPlacedOverlap);
  if (!found) return {};
  return fmt::format(
      "Sphere #{} overlaps an FE body by {:.3g} m, {:.3g} of its radius, and is pushed out with "
      "the energy of that overlap; put it outside.",
      found->sphere, found->depth, found->depth / found->radius);
}

/// Reports those messages that have not been reported yet.
void FESolver::report(std::vector<std::string> sentences) {
  const std::size_t known = world_.warnings.size();
  std::vector<std::string>& warnings = world_.warnings;
  for (std::string& sentence : sentences)
    if (!sentence.empty() &&
        std::find(warnings.begin(), warnings.end(), sentence) == warnings.end())
      warnings.push_back(std::move(sentence));
  warn(known);
}

/// Updates the boundaries of YADE's walls, boxes and facets that the bodies touch.
void FESolver::followRigid(bool enginesAreNew) {
  bool areNew = false;
  try {
    areNew = rigid_.follow(*scene, world_, bodies_, rigidBodies, integrator(true));
  } catch (const InputError& error) {
    throw std::invalid_argument(std::string(error.what()) +
                                " FESolver(rigidBodies=False) disables contact with it.");
  }
  report(rigid_.takeSentences());
  if (!(enginesAreNew || areNew) || !rigid_.any()) return;
  EngineOrder::requireReturn(*scene, *this, rigid_.anyMovable(*scene));
  if (rigid_.anyMovable(*scene) && integrator(false) && !integrator(true))
    report(
        {"NewtonIntegrator comes before FESolver in O.engines: rigid bodies that obey forces keep "
         "their velocity while they touch FE bodies, and light ones rebound too fast; it must come "
         "after FESolver."});
}

/// Adds bodies for new faces, and removes those of removed fragments. The world handles contact of
/// new faces; a search of the collider is needed only if the scene has other bodies.
void FESolver::followCracks(std::uint64_t dropped) {
  const bool wasDue = scene->doSort;
  const std::size_t first = bodies_.ids().size();
  crackContacts_.follow(*scene, world_, bodies_);
  bodies_.follow(*scene, world_);
  if (bodies_.ids().size() > first)
    crackContacts_.change(*scene, world_, bodies_, first, scene->dt);
  if (world_.dropped.count != dropped) bodies_.drop(*scene, world_);
  if (!bodies_.meetOthers(*scene)) scene->doSort = wasDue;
}

/// CurveIntegrator leaves the bodies out: they move here, where their states are written anyway.
void FESolver::updateBodies() {
  yade::NewtonIntegrator* const behind = integrator(true);
  RestOfStep rest;
  if (behind) rest.dt = scene->dt;
  auto* const ours = dynamic_cast<MotionIntegrator*>(behind);
  rest.isOurs = ours && MotionIntegrator::isFast(*scene);
  bodies_.update(world_, rest, world_.threads);
  if (rest.isOurs) ours->leaveOut(*scene, bodies_.idRanges(), bodies_.meetOthers(*scene));
}

/// The first integrator that moves the bodies, null for none; `behind`: only one after this engine.
yade::NewtonIntegrator* FESolver::integrator(bool behind) const {
  const yade::Body* any = bodies_.firstBody();
  if (!any) return nullptr;
  bool passed = !behind;
  for (const auto& engine : scene->engines) {
    if (engine.get() == this) passed = true;
    auto* const newton = dynamic_cast<yade::NewtonIntegrator*>(engine.get());
    if (!newton || newton->dead || !passed) continue;
    if (newton->mask <= 0 || (newton->mask & any->groupMask) != 0) return newton;
  }
  return nullptr;
}

void FESolver::trackEnergy() const {
  const EnergyLedger& ledger = world_.ledger;
  const auto set = [this](const char* name, double value) {
    scene->energy->setItem_py(name, value);
  };
  set("feKinetic", world_.kineticEnergy());
  set("feStrain", world_.strainEnergy());
  set("feContact", ledger.contact);
  set("feFriction", ledger.friction);
  set("feFracture", ledger.fracture);
  set("feDamping", ledger.damping);
  if (settings.minFragmentArea > 0) set("feDropped", ledger.dropped);
  set("feOutside", -ledger.external);  // energy that left: the sum of all is constant
}

}  // namespace yadefrag
