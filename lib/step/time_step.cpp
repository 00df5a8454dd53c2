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
#include "time/critical_time_step.hpp"

namespace yadefrag {

namespace {

/// The model has x* and v*, without contact. Only `predict` makes one. Spans are by node.
struct Predicted {
  StepLength length;
  std::span<const Vec2> position;  ///< m, xⁿ
  std::span<const Vec2> velocity;  ///< m/s, vⁿ⁻½
};

/// The model has xⁿ⁺¹ and vⁿ⁺½. Only `finish` makes one.
struct Finished {
  StepLength length;
  std::span<const Vec2> surfaceForces;  ///< N, by node, of contact and cohesion
};

// --- Stages of `advance`.

/// Internal forces, and those from outside.
Predicted predict(const StepData& data, const StepLength& length) {
  const auto& [state, scratch, exchange, settings] = data;
  const StageTimer timer(data.times(), &StageTimes::forces);
  ExplicitDynamics& dynamics = scratch.dynamics;
  dynamics.predict(state.model, length, settings.dynamicsSettings, state.loads.forces(),
                   settings.threads);
  scratch.undo.hasMoved = true;
  if (dynamics.flow().isOn()) state.ledger.plastic += dynamics.flow().dissipation();
  return {length, dynamics.previousPosition(), dynamics.previousVelocity()};
}

void absorb(const StepData& data, const Predicted& from) {
  WorldState& state = data.state;
  if (state.loads.absorbing.segments.empty()) return;
  state.loads.absorbing.correct(state.model, state.surfaces, from.position, from.velocity,
                                from.length, data.drag(from.length));
}

void applyCohesion(const StepData& data, const Predicted& from) {
  Fracture& fracture = data.state.fracture;
  if (fracture.cohesion.edge.empty()) return;
  const StageTimer timer(data.times(), &StageTimes::fracture);
  fracture.cohesion.correct(data.state.model, fracture.edges, from.position, from.length,
                            data.drag(from.length));
}

void correctContact(const StepData& data, const Predicted& from) {
  const auto& [state, scratch, exchange, settings] = data;
  Cohesion& cohesion = state.fracture.cohesion;
  const ContactStep now{from.length,
                        data.drag(from.length),
                        state.search.largestMove(),
                        scratch.finest,
                        from.position,
                        settings.threads,
                        exchange.rigidMasses,
                        settings.contactSettings.constants,
                        data.times(),
                        cohesion.isPulling() ? &cohesion : nullptr};
  scratch.undo.hasCorrected = true;
  state.contact.correct(state.model, state.surfaces, now);
  for (const RigidMasses::Member& member : exchange.rigidMasses.members)
    scratch.dynamics.setHeld(member.node, state.model.nodes.velocity[member.node.value]);
  state.search.addCorrection(state.contact.largestCorrection());
}

void countContactWork(const StepData& data, const Predicted& from) {
  const StageTimer timer(data.times(), &StageTimes::correction);
  WorldState& state = data.state;
  for (const ContactRow& row : state.contact.rows()) {
    const Vec2 mean =
        .5 * (relative(row, from.velocity) + relative(row, state.model.nodes.velocity));
    state.ledger.contact -= row.normalForce * dot(mean, row.normal) * from.length.velocity;
    state.ledger.friction -= row.tangentForce * dot(mean, row.tangent()) * from.length.velocity;
  }
}

void requireUpright(const StepData& data, double dt) {
  const auto& [state, scratch, exchange, settings] = data;
  const StageTimer timer(data.times(), &StageTimes::forces);
  const auto flattest = scratch.dynamics.requireUpright(
      state.model, dt, scratch.canTouch ? state.contact.largestCorrection() : 0);
  if (flattest.element == ElementId::none()) return;
  state.stableStep = dt;  // a longer step must be checked anew
  const double critical =
      criticalTimeStep(state.model, settings.dynamicsSettings.viscosity, settings.threads);
  if (dt > critical)
    scratch.dynamics.refuseFlat(state.model, flattest, dt, tolerance::kBarrierAdvised * critical);
}

/// Work of all forces except contact, with the mean of both velocities.
Finished finish(const StepData& data, const Predicted& from) {
  const auto& [state, scratch, exchange, settings] = data;
  const StageTimer timer(data.times(), &StageTimes::forces);
  // Reactions of held nodes include contact and cohesive cracks.
  std::span<const Vec2> pushes = state.contact.forces().known;
  Cohesion& cohesion = state.fracture.cohesion;
  if (!cohesion.edge.empty()) {
    scratch.surfaceForces.assign(pushes.begin(), pushes.end());
    scratch.surfaceForces.resize(state.model.nodes.size());
    cohesion.addForces(scratch.surfaceForces);
    pushes = scratch.surfaceForces;
    state.ledger.spin += from.length.velocity * moment(from.position, pushes);
  }
  scratch.dynamics.finish(state.model, from.length, settings.dynamicsSettings, state.loads.forces(),
                          pushes, state.ledger, settings.threads);
  if (!state.loads.absorbing.segments.empty())
    state.loads.absorbing.addWork(state.ledger, state.model, from.velocity, from.length);
  return {from.length, pushes};
}

void countFractureWork(const StepData& data, const Predicted& from) {
  WorldState& state = data.state;
  if (state.fracture.cohesion.edge.empty()) return;
  const StageTimer timer(data.times(), &StageTimes::fracture);
  state.fracture.cohesion.addWork(state.ledger, state.model, from.velocity, from.length);
}

/// From xⁿ, vⁿ⁻½ to xⁿ⁺¹, vⁿ⁺½.
Finished advance(const StepData& data, double dt) {
  const auto& [state, scratch, exchange, settings] = data;
  const StepLength length(dt, state.lastDt);
  // The leapfrog's energy is that of a step: it is not defined before the first one.
  if (state.steps == 0)
    state.watch.begin(state.kineticEnergy() + strainEnergy(state.model, dt), state.ledger);
  drive(data, dt);
  state.loads.sum(state.model, state.surfaces, state.time);
  state.search.boundMotion(data, dt);

  // v* and x*, without contact.
  const Predicted predicted = predict(data, length);
  absorb(data, predicted);

  // Tractions of cohesive cracks.
  applyCohesion(data, predicted);
  requireBoundedMotion(data, dt);

  // Global search, only if a node left the halo of the last one: usually the last candidates are
  // still valid.
  if (scratch.canTouch) {
    state.search.measureMove(data, dt);
    state.search.searchIfLeft(data, dt);
    requireResolvedMotion(data, dt);
    // Local search and correction, from x*, v* to xⁿ⁺¹, vⁿ⁺½. Contact forces act at xⁿ.
    correctContact(data, predicted);
  }
  state.fracture.cohesion.finish(state.model.nodes, length);
  if (scratch.canTouch) countContactWork(data, predicted);
  requireUpright(data, dt);
  if (state.model.axisymmetric) requireOutsideAxis(state.model);

  const Finished finished = finish(data, predicted);
  countFractureWork(data, predicted);
  scratch.ofChange = dt != state.lastDt && state.lastDt > 0
                         ? scratch.dynamics.energyOfChange(state.model, length)
                         : 0;
  // Flow makes steps shorter, with no change of the script.
  if (scratch.dynamics.flow().isOn()) state.ledger.external += std::exchange(scratch.ofChange, 0);
  requireFiniteEnergy(state.ledger);
  return finished;
}

// --- Stages of `conclude`.

void measureReactions(const StepData& data, const Finished& step) {
  const auto& [state, scratch, exchange, settings] = data;
  if (scratch.dynamics.holdsNone()) return exchange.reactions.clear();
  const StageTimer timer(data.times(), &StageTimes::forces);
  scratch.dynamics.measureReactions(state.model, step.length, settings.dynamicsSettings,
                                    state.loads.forces(), step.surfaceForces, exchange.reactions);
}

/// Updates all that is derived from nodes, triangles and the boundary.
void onSplit(const StepData& data) {
  const auto& [state, scratch, exchange, settings] = data;
  const SplitResult& split = scratch.split;
  const Nodes& nodes = state.model.nodes;
  const std::size_t count = nodes.size();
  state.contact.resize(count);
  scratch.dynamics.follow(state.model, split.changed, split.originals);
  (void)relink(state.surfaces, split.sides);
  for (const NodeId node : split.onSurface) state.search.appear(node, nodes.position[node.value]);
  for (std::size_t n = count - split.originals.size(); n < count; ++n)
    state.search.appear(NodeId(n), nodes.position[n]);
  for (const SurfaceSide& side : split.sides)
    if (side.segment == SegmentId::none())
      scratch.finest = std::min(scratch.finest, norm(nodes.reference[side.last.value] -
                                                     nodes.reference[side.first.value]));
  state.search.addCandidatesAround(data, split.sides);
  assert(haveLength(nodes.columns(), count) && state.surfaces.nodeSegment.size() == count);
}

/// Returns true if nodes have split.
bool crack(const StepData& data) {
  const auto& [state, scratch, exchange, settings] = data;
  Fracture& fracture = state.fracture;
  if (!fracture.isOn()) return false;
  const StageTimer timer(data.times(), &StageTimes::fracture);
  fracture.cohesion.keepOpenings(state.model, fracture.edges);
  const bool opened = fracture.crack(state.model, state.surfaces, scratch.dynamics.stressed(),
                                     {state.time, state.lastDt}, scratch.split, settings.threads);
  fracture.noteStart(state.time);
  double gained = fracture.yieldingGain();
  if (opened) gained += fracture.splitEnergy(state.model, scratch.split.originals, state.lastDt);
  state.ledger.fracture -= gained;
  state.watch.split += gained;
  if (opened) onSplit(data);
  fracture.applyCohesion(state.model);
  state.loads.spread(state.model, state.surfaces, fracture);
  // A step that does not resolve a new law is refused at its begin.
  for (const EdgeId edge : fracture.weakened())
    if (!isResolved(state.model, fracture.edges, edge, state.lastDt)) state.stableStep = 0;
  // A loaded state computes the limits from the present strengths.
  if (fracture.hasRaised()) updateStressLimits(state, scratch.dynamics);
  return opened;
}

/// Triangles, nodes and entries keep their numbers. The triangles get their stress-free shape at
/// rest, so that they never move or crack again.
void remove(const StepData& data, std::span<const ElementId> triangles) {
  const auto& [state, scratch, exchange, settings] = data;
  Model& model = state.model;
  std::vector<NodeId> nodes;
  for (const ElementId element : triangles) {
    const auto& corners = model.triangles.nodes[element.value];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  sortUnique(nodes);

  Dropped& dropped = state.dropped;
  dropped.count += scratch.loose.count;
  state.ledger.dropped += strainEnergy(model, state.lastDt, triangles);
  for (const NodeId node : nodes) {
    double& mass = model.nodes.mass[node.value];
    Vec2& velocity = model.nodes.velocity[node.value];
    dropped.mass += mass;
    dropped.momentum += mass * velocity;
    state.ledger.dropped += mass / 2 * dot(velocity, velocity);
    mass = 0;
    velocity = {};
    if (node.value < exchange.reactions.size()) exchange.reactions[node.value] = {};
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
  scratch.dynamics.drop(model, nodes);
  state.fracture.cohesion.removeDropped(model.triangles, state.fracture.edges);
  state.surfaces.drop(nodes);
  state.contact.removeGone(state.surfaces);
  state.search.removeDropped(model);
  scratch.finest = shortestSegment(model, state.surfaces, model.nodes.reference);
}

/// Checks only the surroundings of splits, and everything after a body was added or the area
/// changed. `split`: `crack` has split nodes.
void dropFragments(const StepData& data, bool split) {
  const auto& [state, scratch, exchange, settings] = data;
  const Fracture& fracture = state.fracture;
  const double area = fracture.minFragmentArea;
  if (area <= 0 || !fracture.isOn()) {
    scratch.droppedBelow = 0;
    return;
  }
  const StageTimer timer(data.times(), &StageTimes::fracture);
  std::vector<ElementId> around;
  if (scratch.droppedBelow != area) {
    for (std::size_t e = 0; e < fracture.edges.ofElement.size(); ++e)
      if (state.model.components[state.model.triangles.component[e].value].brittle.cracks())
        around.emplace_back(e);
  } else {
    for (const EdgeId edge : fracture.cohesion.released)
      for (const ElementId element : fracture.edges.element[edge.value]) around.push_back(element);
    if (split) {
      const std::vector<NodeId>& originals = scratch.split.originals;
      const std::size_t firstNew = state.model.nodes.size() - originals.size();
      for (std::size_t i = 0; i < originals.size(); ++i) {
        around.push_back(fracture.edges.ofNode[originals[i].value]);
        around.push_back(fracture.edges.ofNode[firstNew + i]);
      }
    }
  }
  scratch.droppedBelow = area;
  if (around.empty()) return;
  scratch.loose.find(state.model, fracture.edges, fracture.cohesion, around, area);
  if (!scratch.loose.triangles.empty()) remove(data, scratch.loose.triangles);
}

/// Consequences of the new state, which is final.
void conclude(const StepData& data, const Finished& step) {
  const auto& [state, scratch, exchange, settings] = data;
  measureReactions(data, step);
  ++state.steps;
  state.time += step.length.position;
  state.lastDt = step.length.position;
  state.loads.endStep();
  exchange.givenVelocities.clear();
  exchange.rigidVelocities.clear();
  exchange.rigidMasses.clear();
  state.watch.addOfChange(scratch.ofChange);
  watchEnergy(data);

  // Cracks at xⁿ⁺¹: nodes split, surfaces are linked again, and the new faces become candidates.
  // Fragments that are too small are removed.
  const bool split = crack(data);
  dropFragments(data, split);

  if (scratch.canTouch) state.search.foreseeSearch(data, state.lastDt);
}

// --- Undo of `advance`.

void beginUndo(WorldState& state, Scratch& scratch) {
  StepUndo& undo = scratch.undo;
  undo.hasMoved = undo.hasCorrected = false;
  undo.driven.clear();
  undo.former = state;
  undo.steepness = scratch.dynamics.flow().steepness();
  undo.speedLimit = scratch.dynamics.speedLimit();
  state.search.begin();
}

/// Allocates no memory.
void undoAll(WorldState& state, Scratch& scratch) {
  const StepUndo& undo = scratch.undo;
  state.search.undo(state.contact);
  if (undo.hasCorrected) state.contact.undo();
  if (undo.hasMoved) scratch.dynamics.undo(state.model);
  undoDrive(state.model.nodes, undo.driven);
  static_cast<StepFigures&>(state) = undo.former;
  scratch.dynamics.flow().restore(undo.steepness);
  scratch.dynamics.setSpeedLimit(undo.speedLimit);
}

}  // namespace

/// All or nothing: after an exception during the step the state is that before the step.
void World::step(double dt) {
  if (!scratch_.broken.empty()) throw RunError(scratch_.broken);
  const StepData data{*this, scratch_, *this, *this};
  buildIfChanged(data);
  beginUndo(*this, scratch_);
  const auto where = [this](const RunError& error) {
    return fmt::format("Step {}, time {:g} s: {}", steps, time, error.what());
  };
  const Finished finished = [&] {
    try {
      requireStableStep(data, dt);
      return advance(data, dt);
    } catch (const FlatError& error) {
      undoAll(*this, scratch_);
      throw FlatError(where(error), error.advised);
    } catch (const RunError& error) {
      undoAll(*this, scratch_);
      throw RunError(where(error));
    } catch (...) {
      undoAll(*this, scratch_);
      throw;
    }
  }();
  try {
    conclude(data, finished);
  } catch (...) {
    // A partial split of nodes cannot be undone; its usual cause is a lack of memory.
    scratch_.broken =
        "A step ended while cracks opened, and the state is incomplete; load a saved state.";
    throw;
  }
}

}  // namespace yadefrag
