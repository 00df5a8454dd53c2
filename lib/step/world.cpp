#include "step/world.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/dynamics.hpp"
#include "fracture/brittle_checks.hpp"
#include "fracture/edge_strength.hpp"
#include "mesh/assembly.hpp"
#include "step/overlap_check.hpp"
#include "time/critical_time_step.hpp"

namespace yadefrag {

namespace {

/// A body that fails has a factor by triangle, given by place or scattered or both.
void setResistance(Model& model, ComponentId id, const BodySpec& spec) {
  const std::vector<double>& byPlace = spec.places.strength;
  const bool isScattered = spec.brittle.weibullModulus > 0 || spec.brittle.strengthScatter > 0;
  if (!spec.plastic.fails() || (byPlace.empty() && !isScattered)) return;
  const Component& body = model.components[id.value];
  std::vector<double>& resistance = model.triangles.plastic.resistance;
  resistance.resize(model.triangles.size(), 1);
  // Two bodies of the same material get different random numbers, as edges do.
  const std::uint64_t number = std::uint64_t{id.value} << 32;
  for (std::size_t e = body.firstTriangle; e < body.lastTriangle; ++e) {
    const std::size_t i = e - body.firstTriangle;
    if (!byPlace.empty()) resistance[e] = byPlace[i];
    if (isScattered)
      resistance[e] *= scatterFactor(spec.brittle, number + i,
                                     model.depthOf(ElementId(e)) * model.triangles.area[e]);
  }
}

/// Of its edges, which have no strength before a triangle fails.
BrittlePlaces edgePlaces(const BodySpec& spec) {
  BrittlePlaces places = spec.places;
  if (spec.plastic.fails()) places.strength.clear();
  return places;
}

}  // namespace

ComponentId World::addBody(const TriangleMesh& given, const BodySpec& spec) {
  checkBody(given, spec, model.axisymmetric);
  const TriangleMesh moved = model.axisymmetric ? besideAxis(given, spec) : TriangleMesh{};
  const TriangleMesh& mesh = model.axisymmetric ? moved : given;
  requireApart(mesh, spec, "The new body");
  Component component;
  static_cast<BodyMaterial&>(component) = wholeOf(spec);
  component.brittleByPlace = !spec.places.empty() || !spec.materials.empty() || component.fails();
  component.name = spec.name;
  component.thickness = spec.thickness;
  // A fragment has contact with the rest of its body.
  component.selfContact = spec.selfContact || component.brittle.cracks();
  component.element = spec.element;
  const std::size_t first = model.nodes.size();
  const ComponentId id =
      appendBody(model, mesh, component, spec.materials, spec.stress, spec.stressAcross);
  setResistance(model, id, spec);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (!spec.displacement.empty()) model.nodes.position[first + i] += spec.displacement[i];
    if (!spec.velocity.empty()) model.nodes.velocity[first + i] = spec.velocity[i];
    if (!spec.held.empty()) model.nodes.held[first + i] = spec.held[i];
  }
  holdOnAxis(NodeId(first));
  for (const auto& loop : mesh.loops) {
    std::vector<NodeId> nodes;
    std::vector<std::uint8_t> smooth;
    for (const std::uint32_t node : loop) {
      nodes.emplace_back(first + node);
      smooth.push_back(spec.smoothNodes.empty() ? 0 : spec.smoothNodes[node]);
    }
    surfaces.addLoop(nodes, smooth, id);
  }
  openJoints(fracture.addBody(model, id, edgePlaces(spec)));
  // From the first step on a body brings its energy from outside, and takes it there.
  const double energy = energyOf(id, NodeId(first), lastDt);
  if (steps > 0)
    ledger.external += energy;
  else
    watch.join(energy);
  stableStep = 0;
  search.invalidate();
  rebuild();
  return id;
}

/// `purpose`: the intended operation, for the message.
void World::requireBody(ComponentId component, const char* purpose) const {
  if (component.value < model.components.size()) {
    const Component& body = model.components[component.value];
    if (body.firstTriangle != body.lastTriangle) return;
  }
  throw InputError(fmt::format("There is no body {} to {}.", component.value, purpose));
}

void World::removeBody(ComponentId component) {
  requireBody(component, "remove");
  const auto energy = [&] { return kineticEnergy() + strainEnergy() + pendingPlastic(); };
  const double before = energy();
  const ElementId first(model.components[component.value].firstTriangle);
  const ElementId last(model.components[component.value].lastTriangle);
  const std::vector<NodeId> renumbered = yadefrag::removeBody(model, component);
  fracture.removeBody(model, first, last, renumbered);
  std::vector<std::uint8_t> gone(model.components.size());
  gone[component.value] = 1;
  takeOff(gone, renumbered);
  const double after = energy();
  if (steps > 0) ledger.external -= before - after;
  watch.begin(after, ledger);
  stableStep = 0;
}

/// Removes the data of removed components. Returns the new numbers of entries.
std::vector<EntryId> World::takeOff(const std::vector<std::uint8_t>& gone,
                                    std::span<const NodeId> renumbered) {
  search.invalidate();
  places_.clear();
  reactions.clear();
  auto [segments, entries] = surfaces.removeComponents(gone);
  loads.renumber(segments);
  surfaces.renumberNodes(renumbered, model.nodes.size());
  removeUnusedMotions();
  contact.renumber(entries);
  rebuild();
  return std::move(entries);
}

void World::setPressure(std::span<const NodeId> nodes, TimeTable value, std::uint32_t function,
                        bool intoCracks) {
  requireNodes(nodes);
  loads.setPressure(model, surfaces, nodes, std::move(value), function, intoCracks);
}

void World::setAbsorbing(std::span<const NodeId> nodes) {
  requireNodes(nodes);
  loads.setAbsorbing(model, surfaces, nodes);
}

void World::setLoads(std::vector<Vec2> byNode) {
  if (!byNode.empty() && byNode.size() != model.nodes.size())
    throw InputError(
        fmt::format("There are {} loads, but {} nodes.", byNode.size(), model.nodes.size()));
  for (std::size_t i = 0; i < byNode.size(); ++i)
    if (!isFinite(byNode[i]))
      throw InputError(fmt::format("The load of node {} is not finite.", i));
  model.nodes.load = std::move(byNode);
}

/// Derived data are made anew before the next step.
void World::noteChange() {
  loadedSteepness = steepness();
  isBuilt_ = false;
}

void World::rebuild() {
  broken_.clear();
  rigidNodes_.clear();
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.components[model.nodes.component[n].value].rigid) rigidNodes_.emplace_back(n);
  contact.resize(model.nodes.size());
  noteChange();
}

void World::buildIfChanged() {
  if (isBuilt_) return;
  places_.clear();
  dynamics_.rebuild(model);
  if (stableStep > 0) dynamics_.flow().restore(loadedSteepness);
  loads.absorbing.findTriangles(model, surfaces);
  for (std::size_t n = 0; n < reactions.size(); ++n)
    if (model.nodes.held[n] == 0) reactions[n] = {};
  const auto& owners = surfaces.component;
  severalBodies_ =
      std::adjacent_find(owners.begin(), owners.end(), std::not_equal_to<>()) != owners.end();
  if (fracture.isOn()) {
    fracture.prepare(model);
    const std::size_t room = model.nodes.position.capacity();
    surfaces.nodeSegment.reserve(room);
    dynamics_.reserve(room);
    contact.reserve(room);
  }
  measureFinest();
  search.rebuild(searchScene());
  updateStressLimits();
  droppedBelow_ = 0;
  isBuilt_ = true;
}

/// Only elements that can crack are checked, and only if their stress is near the strength of their
/// weakest edge.
void World::updateStressLimits() {
  std::vector<double>& least = fracture.leastStrength;
  least.assign(fracture.isOn() ? model.components.size() : 0, INFINITY);
  const CrackEdges& edges = fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges.isBond(model, EdgeId(i))) continue;
    const ComponentId body = model.triangles.component[edges.element[i][0].value];
    least[body.value] = std::min(least[body.value], edges.strength[i]);
  }
  dynamics_.setStressLimits(least);
}

double World::criticalTimeStep() const {
  return yadefrag::criticalTimeStep(model, dynamicsSettings.viscosity, threads);
}

/// Checked only before the first step, and when the step or the viscosity has changed or bodies
/// were added or removed. The reduction of the critical step by elements that nearly collapse is
/// checked in every step (requireUpright).
void World::requireStableStep(double dt) {
  const BulkViscosity& viscosity = dynamicsSettings.viscosity;
  const bool flowed = dynamics_.flow().isSteeper();
  if (dt > 0 && dt <= stableStep && viscosity == stableViscosity && !flowed) return;
  const double critical = criticalTimeStep();
  if (critical == 0)
    throw TimeStepError("No time step is stable: a velocity or a node's place is too large.");
  // Without elements any finite step is stable.
  if (!(dt > 0 && dt <= critical && std::isfinite(dt)))
    throw TimeStepError(
        fmt::format("The time step is {:g} s, but must be above 0 and at most {:g} s, the critical "
                    "step of the present mesh.",
                    dt, critical));
  for (std::size_t c = 0; c < model.components.size(); ++c)
    if (model.components[c].brittle.cracks())
      checkCohesiveResolution(model, fracture.edges, ComponentId(c), dt);
  checkBondResolution(model, fracture.edges, dt);
  stableStep = dt;
  stableViscosity = viscosity;
  if (dynamics_.flow().isOn()) dynamics_.flow().noteSteepest(model);
}

// --- World: bonds between bodies.

std::size_t World::bond(ComponentId a, ComponentId b, double strength, double energy,
                        ConformPlan* done) {
  checkBond(strength, energy);
  requireBody(a, "bond");
  requireBody(b, "bond");
  if (a == b) throw InputError("A body cannot be bonded to itself; joints= is for that.");
  const CommonSides found = conformedSides(
      std::array{a, b}, 0, [&](const CommonSides& sides) { requireMatch(sides, a, b); }, done);
  bond(found, strength, energy);
  return found.pairs.size();
}

CommonSides World::bondAll(double reach, double strength, double energy, ConformPlan* done) {
  checkBond(strength, energy);
  CommonSides found = conformedSides(bodiesOf(model), reach, {}, done);
  if (!found.pairs.empty()) bond(found, strength, energy);
  return found;
}

/// The common sides after those with different ends got the same ones, if that lets more of them
/// match. `check` may refuse the result; nothing is changed then.
CommonSides World::conformedSides(std::span<const ComponentId> bodies, double reach,
                                  const std::function<void(const CommonSides&)>& check,
                                  ConformPlan* done) {
  CommonSides found = commonSides(model, fracture.edges, bodies, reach);
  const auto accept = [&](const CommonSides& sides) {
    if (check) check(sides);
  };
  if (found.unmatched == 0) {
    accept(found);
    return found;
  }
  ConformPlan plan = planConforming(model, fracture.edges, bodies, reach);
  Model changed = model;
  CrackEdges edges = fracture.edges;
  const DividedSides divided = conform(changed, edges, surfaces, plan);
  found = commonSides(changed, edges, bodies, reach);
  accept(found);
  if (found.pairs.empty()) return found;
  model = std::move(changed), fracture.edges = std::move(edges);
  onDivision(divided);
  if (done != nullptr) *done = std::move(plan);
  return found;
}

/// Updates the boundary and all that refers to it.
void World::onDivision(const DividedSides& divided) {
  (void)relink(surfaces, divided.sides);
  loads.onDivision(surfaces, divided.parents);
  search.invalidate();
  places_.clear();
  rebuild();
  watch.begin(kineticEnergy() + strainEnergy() + pendingPlastic(), ledger);
}

void World::bond(const CommonSides& sides, double strength, double energy) {
  fracture.bond(model, sides.pairs, strength, energy);
  stableStep = 0;
  isBuilt_ = false;
}

}  // namespace yadefrag
