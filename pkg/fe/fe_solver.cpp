#include "fe/fe_solver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <mutex>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "collider/motion_watch.hpp"
#include "core/errors.hpp"
#include "core/tolerances/plasticity.hpp"
#include "core/tolerances/spheres.hpp"
#include "core/tolerances/step.hpp"
#include "core/wrong_value.hpp"
#include "dynamics/yielding_state.hpp"
#include "entries/sphere_overlap.hpp"
#include "fe/plastic_materials.hpp"
#include "fe/running.hpp"
#include "fracture/brittle_checks.hpp"
#include "fracture/coarse_mesh.hpp"
#include "integrator/curve_integrator.hpp"

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
  if (scene->isPeriodic)
    throw std::invalid_argument("FESolver: the scene is periodic, but FE bodies cannot be.");
  const bool enginesAreNew = order_.require(*scene, *this);
  bodies_.requireAll(*scene);
  giveSettings();
  followFlow();
  checkScene(enginesAreNew);
  followRigid(enginesAreNew);
  if (world_.search.isDue()) checkBodies();
  const std::uint64_t dropped = world_.dropped.count, searches = world_.numSearches();
  const std::size_t known = world_.warnings.size();
  collectForces();
  functions_.giveValues(world_, scene->dt);
  rigid_.giveVelocities(*scene, world_, integrator(true));
  const StepLength length(scene->dt, world_.lastDt);
  balance_.begin(*scene, world_, bodies_,
                 {integrator(false) != nullptr, order_.spheresMoveFirst()});
  try {
    world_.step(scene->dt);
  } catch (const TimeStepError& error) {
    throw std::invalid_argument("O.dt: " + std::string(error.what()) + byTimeStepper(*scene));
  } catch (const InputError& error) {
    throw std::invalid_argument(error.what());
  }
  loadedForces_.clear();
  warn(known);
  if (rigid_.any()) {
    rigid_.giveForces(*scene, world_, length, given_);
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

/// Reduces O.dt if plastic flow has made triangles so flat that it is above the critical step.
void FESolver::followFlow() {
  if (!world_.hasFlowed()) return;
  const double critical = world_.criticalTimeStep();
  if (scene->dt <= critical) return;
  scene->dt = tolerance::kFlowStep * critical;
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
         "FE "
         "bodies with each other; they have with spheres and other bodies of YADE."});
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
  const yade::Vector3r theirs = newton ? newton->gravity : yade::Vector3r::Zero();
  if (takesGravity) {
    // One that is not finite is no setting; the step refuses it.
    world_.dynamicsSettings.gravity = {theirs[0], theirs[1]};
    const yade::Vector3r taken(theirs[0], theirs[1], 0);
    if (taken.allFinite() && taken != gravity) gravity = formerGravity_ = taken;
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
  const auto found = deepestOverlap(*scene, first, bodies_.anyBody()->groupMask, triangles,
                                    isLoaded ? tolerance::kDeepSphere : tolerance::kPlacedOverlap);
  if (!found) return {};
  return fmt::format(
      "Sphere #{} overlaps an FE body by {:.3g} m, {:.3g} of its radius, and is pushed out with "
      "the "
      "energy of that overlap; put it outside.",
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
  const yade::Body* any = bodies_.anyBody();
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
  if (minFragmentArea > 0) set("feDropped", ledger.dropped);
  set("feOutside", -ledger.external);  // energy that left: the sum of all is constant
}

/// Bodies of two solvers would have no contact with each other.
void FESolver::requireAlone(const yade::Scene& here) const {
  const auto& present = here.bodies->body;
  for (std::size_t id = 0; id < present.size(); ++id) {
    if (bodies_.entryOf(static_cast<yade::Body::id_t>(id)) != EntryId::none() || !present[id])
      continue;
    const auto* segment = dynamic_cast<const SurfaceSegment*>(present[id]->shape.get());
    if (segment && segment->entry >= 0)
      throw InputError(
          "The scene has bodies of another FESolver; add this one to that solver, or they would "
          "not touch each other.");
  }
}

namespace {

/// Throws InputError for a brittle material that cannot crack.
BodyMaterial bodyMaterialOf(const FEMat& material) {
  BodyMaterial one;
  one.material = {material.young, material.poisson, material.density, material.planeStress};
  if (!(material.frictionAngle >= 0 && material.frictionAngle < std::numbers::pi / 2))
    throw InputError(
        wrongValue("frictionAngle", material.frictionAngle, "", "at least 0 and below π/2 (rad)"));
  one.friction = std::tan(material.frictionAngle);
  if (const auto* brittle = dynamic_cast<const BrittleFEMat*>(&material)) {
    one.brittle = {.tensileStrength = brittle->tensileStrength,
                   .fractureEnergy = brittle->fractureEnergy,
                   .shearFactor = brittle->shearFactor,
                   .shearEnergyFactor = brittle->shearEnergyFactor,
                   .weibullModulus = brittle->weibullModulus,
                   .strengthScatter = brittle->strengthScatter,
                   .seed = static_cast<std::uint64_t>(brittle->seed),
                   .referenceVolume = brittle->referenceVolume,
                   .softening = brittle->softening.law(),
                   .rate = brittle->rateEffect.law(),
                   .rateEnergyPower = brittle->rateEnergyPower};
    checkBrittle(one.brittle);
  }
  if (const auto* plastic = dynamic_cast<const PlasticFEMat*>(&material)) {
    one.plastic = plastic->constants();
    one.brittle.weibullModulus = plastic->weibullModulus;
    one.brittle.strengthScatter = plastic->strengthScatter;
    one.brittle.seed = static_cast<std::uint64_t>(plastic->seed);
    one.brittle.referenceVolume = plastic->referenceVolume;
    if (const std::string wrong = one.plastic.wrong(); !wrong.empty()) throw InputError(wrong);
  }
  if (const auto* frictional = dynamic_cast<const FrictionalFEMat*>(&material)) {
    if (!(frictional->internalFriction >= 0 && frictional->internalFriction < std::numbers::pi / 2))
      throw InputError(
          fmt::format("internalFriction is {:g}; it must be at least 0 and below π/2 (rad).",
                      frictional->internalFriction));
    if (!(frictional->dilationAngle >= 0 &&
          frictional->dilationAngle <= frictional->internalFriction))
      throw InputError(
          fmt::format("dilationAngle is {:g}; it must be at least 0 and at most internalFriction.",
                      frictional->dilationAngle));
    one.plastic = frictional->constants();
    if (frictional->cohesion == 0 && frictional->internalFriction == 0)
      throw InputError("cohesion and internalFriction are 0; one of them must be positive.");
    if (const std::string wrong = one.plastic.wrong(); !wrong.empty()) throw InputError(wrong);
  }
  return one;
}

/// BrittleFEMat.coarseMesh of each material.
std::vector<CoarseMesh> choicesOf(const std::vector<yade::shared_ptr<FEMat>>& materials) {
  std::vector<CoarseMesh> choices;
  for (const auto& one : materials) {
    const auto* brittle = dynamic_cast<const BrittleFEMat*>(one.get());
    choices.push_back(brittle ? coarseMeshNamed(brittle->coarseMesh) : CoarseMesh::kWarn);
  }
  return choices;
}

/// Changes `spec.places`. Returns a sentence on that, or an empty one.
std::string fitToCoarseMesh(const TriangleMesh& mesh, BodySpec& spec,
                            std::span<const CoarseMesh> choices) {
  const BodyMaterial& one = spec;
  const std::span<const BodyMaterial> all =
      spec.materials.empty() ? std::span(&one, 1) : std::span(spec.materials.materials);
  const FittedValues fitted =
      fitToMesh(mesh, {all, choices, spec.materials.ofTriangle}, spec.places);
  if (fitted.triangles == 0) return {};
  std::string changed;
  if (fitted.leastStrength < 1)
    changed = fmt::format("the strength is reduced, to {:.3g} of it", fitted.leastStrength);
  if (fitted.mostEnergy > 1)
    changed += fmt::format("{}the fracture energy is raised, to {:.3g} times it",
                           changed.empty() ? "" : ", ", fitted.mostEnergy);
  return fmt::format(
      "{} of {} triangles do not resolve the cohesive zone: {} for the largest (coarseMesh).",
      fitted.triangles, mesh.triangles.size(), changed);
}

/// Throws InputError if the new body is where a sphere is.
void requireApartFromSpheres(const yade::Scene& scene, const TriangleMesh& mesh,
                             const BodySpec& spec) {
  std::vector<std::array<Vec2, 3>> triangles;
  const auto at = [&](std::uint32_t node) {
    return spec.displacement.empty() ? mesh.nodes[node]
                                     : mesh.nodes[node] + spec.displacement[node];
  };
  if (!spec.displacement.empty() && spec.displacement.size() != mesh.nodes.size()) return;
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({at(a), at(b), at(c)});
  const auto found = deepestOverlap(scene, 0, 1, triangles, tolerance::kPlacedOverlap);
  if (found)
    throw InputError(
        fmt::format("The new body overlaps sphere #{} by {:.3g} m, {:.3g} of its radius; it may "
                    "touch others at "
                    "the start, but not overlap them.",
                    found->sphere, found->depth, found->depth / found->radius));
}

/// If the initial stress of a body is outside of its yield surface.
std::string startWarning(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  const std::size_t count = body.yields() ? countYielding(model, component) : 0;
  if (count == 0) return {};
  return fmt::format(
      "The initial stress is outside of the yield surface in {} of {} triangles, which flow in the "
      "first step: take a lower stress, or in plane strain another one across the plane (the "
      "fourth "
      "number).",
      count, body.lastTriangle - body.firstTriangle);
}

}  // namespace

AddedBody FESolver::addBody(const TriangleMesh& mesh, BodySpec spec,
                            const std::vector<yade::shared_ptr<FEMat>>& materials) {
  yade::Scene& here = *yade::Omega::instance().getScene();
  if (here.isPeriodic) throw InputError("The scene is periodic, but FE bodies cannot be.");
  bodies_.requireAll(here);
  requireAlone(here);
  if (spec.materials.ofTriangle.empty())
    static_cast<BodyMaterial&>(spec) = bodyMaterialOf(*materials.front());
  else
    for (const auto& one : materials) spec.materials.materials.push_back(bodyMaterialOf(*one));
  if (!spec.selfContact && wholeOf(spec).brittle.cracks())
    throw InputError(
        "selfContact is False, but the material is a BrittleFEMat or fails, and its fragments must "
        "touch each other; it must be True, or the material an FEMat.");
  const std::vector<CoarseMesh> choices = choicesOf(materials);
  requireApartFromSpheres(here, mesh, spec);
  std::string message = fitToCoarseMesh(mesh, spec, choices);
  const ComponentId component = world_.addBody(mesh, spec);
  if (message.empty() && std::ranges::find(choices, CoarseMesh::kWarn) != choices.end())
    message = cohesiveZoneWarning(world_.model, world_.fracture.edges, component);
  if (!spec.stress.empty()) {
    const std::string yields = startWarning(world_.model, component);
    if (!yields.empty()) message += (message.empty() ? "" : " ") + yields;
  }
  scene = &here;
  bodies_.add(here, world_, materials);
  for (const auto& one : materials) materials_.add(one);
  return {static_cast<int>(component.value), std::move(message)};
}

/// Nodes have moved, or sides were divided.
void FESolver::followBonds() {
  yade::Scene& here = *yade::Omega::instance().getScene();
  bodies_.follow(here, world_);
  bodies_.update(world_, {}, 1);
  here.doSort = true;
}

void FESolver::removeBody(int component) {
  yade::Scene& here = *yade::Omega::instance().getScene();
  bodies_.requireAll(here);
  const auto& components = world_.model.components;
  const auto index = static_cast<std::size_t>(component);
  if (component < 0 || index >= components.size() ||
      components[index].firstTriangle == components[index].lastTriangle)
    throw InputError(fmt::format("component is {}, which is no body of this FESolver.", component));
  balance_.forget(world_, ComponentId(index));
  loadedForces_.clear();
  bodies_.remove(here, world_, ComponentId(index));
  world_.removeBody(ComponentId(index));
}

double FESolver::criticalTimeStep() {
  giveSettings();
  return world_.criticalTimeStep();
}

}  // namespace yadefrag
