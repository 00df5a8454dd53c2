// One step of all bodies, in the order of the paper (§2, §4, §5).

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/arrays.hpp"
#include "core/errors.hpp"
#include "core/tolerances/contact.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/step.hpp"
#include "fracture/brittle_checks.hpp"
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
    undo();
    throw RunError(fmt::format("Step {}, time {:g} s: {}", steps, time, error.what()));
  } catch (...) {
    undo();
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
  search.boundMotion(searchScene(), dt);

  // Internal forces, then v* and x*, without contact.
  predict(length);
  absorb(length);

  // Tractions of cohesive cracks.
  applyCohesion(length);
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
  if (model.axisymmetric) requireOutsideAxis();

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
void World::undo() {
  search.undo(searchScene());
  if (undo_.hasCorrected) contact.undo();
  if (undo_.hasMoved) dynamics_.undo(model);
  undoDrive();
  ledger = undo_.ledger;
  watch = undo_.watch;
  stableStep = undo_.stableStep, stableViscosity = undo_.stableViscosity;
  dynamics_.flow().restore(undo_.steepness);
  dynamics_.setSpeedLimit(undo_.speedLimit);
}

void World::measureFinest() { finest_ = shortestSegment(model, surfaces, model.nodes.reference); }

/// A single body that cannot touch itself needs neither search nor candidates.
bool World::canTouch() const {
  const std::vector<ComponentId>& owners = surfaces.component;
  if (owners.empty()) return false;
  return model.components[owners.front().value].selfContact || severalBodies_;
}

SearchSchedule::Scene World::searchScene() {
  return {model,
          surfaces,
          contactSettings,
          finest_,
          canTouch(),
          hasRigid(),
          !fracture.cohesion.edge.empty(),
          threads,
          timesIfRequested(),
          dynamics_,
          contact};
}

void World::correctContact(const StepLength& length) {
  const double most = search.largestMove();
  const ContactStep now{length,
                        dynamicsSettings.drag(length),
                        most,
                        finest_,
                        dynamics_.previousPosition(),
                        threads,
                        rigidMasses,
                        contactSettings.constants,
                        timesIfRequested(),
                        fracture.cohesion.isPulling() ? &fracture.cohesion : nullptr};
  undo_.hasCorrected = true;
  contact.correct(model, surfaces, now);
  for (const RigidMasses::Member& member : rigidMasses.members)
    dynamics_.setHeld(member.node, model.nodes.velocity[member.node.value]);
  search.addCorrection(contact.largestCorrection());
}

void World::countContactWork(const StepLength& length) {
  const StageTimer timer(timesIfRequested(), &StageTimes::correction);
  const std::span<const Vec2> former = dynamics_.previousVelocity();
  for (const ContactRow& row : contact.rows()) {
    const Vec2 mean = .5 * (relative(row, former) + relative(row, model.nodes.velocity));
    ledger.contact -= row.normalForce * dot(mean, row.normal) * length.velocity;
    ledger.friction -= row.tangentForce * dot(mean, row.tangent()) * length.velocity;
  }
}

void World::applyCohesion(const StepLength& length) {
  if (fracture.cohesion.edge.empty()) return;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.correct(model, fracture.edges, dynamics_.previousPosition(), length,
                            dynamicsSettings.drag(length));
}

void World::countFractureWork(const StepLength& length) {
  if (fracture.cohesion.edge.empty()) return;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.addWork(ledger, model, dynamics_.previousVelocity(), length);
}

/// Returns true if nodes have split.
bool World::crack() {
  if (!fracture.isOn()) return false;
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  fracture.cohesion.keepOpenings(model, fracture.edges);
  const bool opened =
      fracture.crack(model, surfaces, dynamics_.stressed(), {time, lastDt}, split_, threads);
  fracture.noteStart(time);
  double gained = fracture.yieldingGain();
  if (opened) gained += fracture.splitEnergy(model, split_.originals, lastDt);
  ledger.fracture -= gained;
  watch.split += gained;
  if (opened) onSplit();
  fracture.applyCohesion(model);
  loads.spread(model, surfaces, fracture);
  // A step that does not resolve a new law is refused at its begin.
  for (const EdgeId edge : fracture.weakened())
    if (!isResolved(model, fracture.edges, edge, lastDt)) stableStep = 0;
  // A loaded state computes the limits from the present strengths.
  if (fracture.hasRaised()) updateStressLimits();
  return opened;
}

/// For a new body, before other data depend on it.
void World::openJoints(std::span<const EdgeId> joints) {
  if (joints.empty()) return;
  fracture.open(model, surfaces, joints, split_);
  (void)relink(surfaces, split_.sides);
}

/// Updates all that is derived from nodes, triangles and the boundary.
void World::onSplit() {
  const std::vector<Vec2>& reference = model.nodes.reference;
  const std::size_t count = model.nodes.size();
  contact.resize(count);
  dynamics_.follow(model, split_.changed, split_.originals);
  (void)relink(surfaces, split_.sides);
  const auto appear = [&](NodeId node) { search.appear(node, model.nodes.position[node.value]); };
  for (const NodeId node : split_.onSurface) appear(node);
  for (std::size_t n = count - split_.originals.size(); n < count; ++n) appear(NodeId(n));
  for (const SurfaceSide& side : split_.sides)
    if (side.segment == SegmentId::none())
      finest_ = std::min(finest_, norm(reference[side.last.value] - reference[side.first.value]));
  search.addCandidatesAround(searchScene(), split_.sides);
  assert(haveLength(model.nodes.columns(), count) && surfaces.nodeSegment.size() == count);
}

/// Must be called after the cracks of a step; `split`: nodes have split. Checks only the
/// surroundings of splits, and everything after a body was added or the area changed.
void World::dropFragments(bool split) {
  const double area = fracture.minFragmentArea;
  if (area <= 0 || !fracture.isOn()) {
    droppedBelow_ = 0;
    return;
  }
  const StageTimer timer(timesIfRequested(), &StageTimes::fracture);
  std::vector<ElementId> around;
  if (droppedBelow_ != area) {
    for (std::size_t e = 0; e < fracture.edges.ofElement.size(); ++e)
      if (model.components[model.triangles.component[e].value].brittle.cracks())
        around.emplace_back(e);
  } else {
    for (const EdgeId edge : fracture.cohesion.released)
      for (const ElementId element : fracture.edges.element[edge.value]) around.push_back(element);
    if (split) {
      const std::size_t firstNew = model.nodes.size() - split_.originals.size();
      for (std::size_t i = 0; i < split_.originals.size(); ++i) {
        around.push_back(fracture.edges.ofNode[split_.originals[i].value]);
        around.push_back(fracture.edges.ofNode[firstNew + i]);
      }
    }
  }
  droppedBelow_ = area;
  if (around.empty()) return;
  loose_.find(model, fracture.edges, fracture.cohesion, around, area);
  if (!loose_.triangles.empty()) remove(loose_.triangles);
}

/// Triangles, nodes and entries keep their numbers. The triangles get their stress-free shape at
/// rest, so that they never move or crack again.
void World::remove(std::span<const ElementId> triangles) {
  std::vector<NodeId> nodes;
  for (const ElementId element : triangles) {
    const auto& corners = model.triangles.nodes[element.value];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  sortUnique(nodes);

  dropped.count += loose_.count;
  ledger.dropped += yadefrag::strainEnergy(model, lastDt, triangles);
  for (const NodeId node : nodes) {
    double& mass = model.nodes.mass[node.value];
    Vec2& velocity = model.nodes.velocity[node.value];
    dropped.mass += mass;
    dropped.momentum += mass * velocity;
    ledger.dropped += mass / 2 * dot(velocity, velocity);
    mass = 0;
    velocity = {};
    if (node.value < reactions.size()) reactions[node.value] = {};
    model.nodes.position[node.value] = model.nodes.reference[node.value];
    model.nodes.held[node.value] = kHeldXY;
  }
  for (const ElementId element : triangles) {
    model.triangles.area[element.value] = 0;
    PlasticState& flowed = model.triangles.plastic;
    if (flowed.isUsed())
      flowed.begin(element.value, model.triangles.inverseEdges[element.value],
                   flowed.temperature[element.value]);
  }
  dynamics_.drop(model, nodes);
  fracture.cohesion.removeDropped(model.triangles, fracture.edges);
  surfaces.drop(nodes);
  contact.removeGone(surfaces);
  search.removeDropped(model);
  measureFinest();
}

}  // namespace yadefrag
