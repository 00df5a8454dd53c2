// Before a step: scratch that follows added, changed and removed bodies; the check of its length.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/errors.hpp"
#include "fracture/brittle_checks.hpp"
#include "step/stages.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {

void buildIfChanged(const StepData& data) {
  const auto& [state, scratch, exchange, settings] = data;
  if (scratch.isBuilt) return;
  Model& model = state.model;
  const ContactSurfaces& surfaces = state.surfaces;
  ExplicitDynamics& dynamics = scratch.dynamics;
  scratch.places.clear();
  dynamics.rebuild(model);
  if (state.stableStep > 0) dynamics.flow().restore(state.loadedSteepness);
  state.loads.absorbing.findTriangles(model, surfaces);
  for (std::size_t n = 0; n < exchange.reactions.size(); ++n)
    if (model.nodes.held[n] == 0) exchange.reactions[n] = {};
  const auto& owners = surfaces.component;
  scratch.canTouch = !owners.empty() && (model.components[owners.front().value].selfContact ||
                                         std::adjacent_find(owners.begin(), owners.end(),
                                                            std::not_equal_to<>()) != owners.end());
  if (state.fracture.isOn()) {
    state.fracture.prepare(model);
    const std::size_t room = model.nodes.position.capacity();
    state.surfaces.nodeSegment.reserve(room);
    dynamics.reserve(room);
    state.contact.reserve(room);
  }
  scratch.finest = shortestSegment(model, surfaces, model.nodes.reference);
  state.search.rebuild(data);
  updateStressLimits(state, dynamics);
  scratch.droppedBelow = 0;
  scratch.isBuilt = true;
}

/// Only elements that can crack are checked, and only if their stress is near the strength of their
/// weakest edge.
void updateStressLimits(WorldState& state, ExplicitDynamics& dynamics) {
  const Model& model = state.model;
  std::vector<double>& least = state.fracture.leastStrength;
  least.assign(state.fracture.isOn() ? model.components.size() : 0, INFINITY);
  const CrackEdges& edges = state.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges.isBond(model, EdgeId(i))) continue;
    const ComponentId body = model.triangles.component[edges.element[i][0].value];
    least[body.value] = std::min(least[body.value], edges.strength[i]);
  }
  dynamics.setStressLimits(least);
}

void requireStableStep(const StepData& data, double dt) {
  const auto& [state, scratch, exchange, settings] = data;
  const Model& model = state.model;
  const BulkViscosity& viscosity = settings.dynamicsSettings.viscosity;
  PlasticFlow& flow = scratch.dynamics.flow();
  if (dt > 0 && dt <= state.stableStep && viscosity == state.stableViscosity && !flow.isSteeper())
    return;
  const double critical = criticalTimeStep(model, viscosity, settings.threads);
  if (critical == 0)
    throw TimeStepError("No time step is stable: a velocity or a node's place is too large.");
  // Without elements any finite step is stable.
  if (!(dt > 0 && dt <= critical && std::isfinite(dt)))
    throw TimeStepError(
        fmt::format("The time step is {:g} s, but must be above 0 and at most {:g} s, the critical "
                    "step of the present mesh.",
                    dt, critical));
  const CrackEdges& edges = state.fracture.edges;
  for (std::size_t c = 0; c < model.components.size(); ++c)
    if (model.components[c].brittle.cracks())
      checkCohesiveResolution(model, edges, ComponentId(c), dt);
  checkBondResolution(model, edges, dt);
  state.stableStep = dt;
  state.stableViscosity = viscosity;
  if (flow.isOn()) flow.noteSteepest(model);
}

}  // namespace yadefrag
