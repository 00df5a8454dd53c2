#include "step/world.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/tolerances/mesh.hpp"
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

/// (J) Energy of a body's nodes and of its elements, in a step of
/// `dt` (s).
double energyOf(const Model& model, ComponentId body, double dt) {
  double twice = 0;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes.component[n] == body)
      twice += model.nodes.mass[n] * dot(model.nodes.velocity[n], model.nodes.velocity[n]);
  const Component& component = model.components[body.value];
  std::vector<ElementId> elements;
  for (std::size_t e = component.firstTriangle; e < component.lastTriangle; ++e)
    elements.emplace_back(e);
  return twice / 2 + strainEnergy(model, dt, elements);
}

/// Of its edges, which have no strength before a triangle fails.
BrittlePlaces edgePlaces(const BodySpec& spec) {
  BrittlePlaces places = spec.places;
  if (spec.plastic.fails()) places.strength.clear();
  return places;
}

}  // namespace

/// Contact prevents new overlaps only; bodies that overlap initially would pass through each other.
void World::requireApart(const TriangleMesh& mesh, const BodySpec& spec,
                         const std::string& subject) {
  BodyPlaces& places = scratch_.places;
  if (scratch_.isBuilt)
    places.clear();  // a step may have moved bodies; between steps they are only added
  places.update(model, surfaces);
  const auto overlap = findOverlap(model, surfaces, places, mesh, spec);
  if (!overlap) return;
  const Component& other = model.components[overlap->body.value];
  throw OverlapError(
      fmt::format("{} overlaps {} at ({:.9g}, {:.9g}) m by {:.3g} m; it may touch others at the "
                  "start, but not overlap them.",
                  subject, other.rigid ? other.name : fmt::format("body {}", overlap->body.value),
                  overlap->place.x, overlap->place.y, overlap->depth),
      overlap->depth);
}

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
  const double brought = energyOf(model, id, lastDt);
  if (steps > 0)
    ledger.external += brought;
  else
    watch.join(brought);
  stableStep = 0;
  search.invalidate();
  rebuild();
  return id;
}

/// For a new body, before other data depend on it.
void World::openJoints(std::span<const EdgeId> joints) {
  if (joints.empty()) return;
  fracture.open(model, surfaces, joints, scratch_.split);
  (void)relink(surfaces, scratch_.split.sides);
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
  scratch_.places.clear();
  reactions.clear();
  auto [segments, entries] = surfaces.removeComponents(gone);
  loads.renumber(segments);
  surfaces.renumberNodes(renumbered, model.nodes.size());
  removeUnusedMotions(model);
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

double World::criticalTimeStep() const {
  return yadefrag::criticalTimeStep(model, dynamicsSettings.viscosity, threads);
}

/// Derived data are made anew before the next step.
void World::noteChange() {
  loadedSteepness = steepness();
  scratch_.isBuilt = false;
}

void World::rebuild() {
  scratch_.broken.clear();
  scratch_.rigidNodes.clear();
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (model.components[model.nodes.component[n].value].rigid) scratch_.rigidNodes.emplace_back(n);
  contact.resize(model.nodes.size());
  noteChange();
}

// --- World: bodies around an axis (Model::axisymmetric), which no node may cross.

void World::setAxisymmetric(bool on) {
  if (on == model.axisymmetric) return;
  if (!model.nodes.position.empty())
    throw InputError("axisymmetric can change only as long as FESolver has no bodies.");
  model.axisymmetric = on;
}

/// The mesh with the nodes that are on the axis except for rounding exactly there. InputError for a
/// mesh, a displacement or a material that an axis forbids.
TriangleMesh World::besideAxis(TriangleMesh mesh, const BodySpec& spec) const {
  double farthest = 0;
  for (const Vec2 node : mesh.nodes) farthest = std::max({farthest, node.x, std::abs(node.y)});
  const auto refuse = [](const char* what, double value) {
    throw InputError(
        fmt::format("{} x = {:g} m, but in an axisymmetric scene x is the distance from the axis: "
                    "it must not be "
                    "negative, and nodes on the axis stay there.",
                    what, value));
  };
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    double& x = mesh.nodes[i].x;
    if (std::abs(x) <= tolerance::kLeastSize * farthest) x = 0;
    if (x < 0) refuse("A node of the mesh is at", x);
    if (spec.displacement.empty()) continue;
    const double now = x + spec.displacement[i].x;
    if (x == 0 ? now != 0 : now <= 0) refuse("displacement moves a node to", now);
  }
  const auto isPlane = [](const BodyMaterial& one) { return one.material.planeStress; };
  if (isPlane(spec) || std::ranges::any_of(spec.materials.materials, isPlane))
    throw InputError("planeStress is set, but an axisymmetric body has stresses around its axis.");
  return mesh;
}

void World::holdOnAxis(NodeId first) {
  if (!model.axisymmetric) return;
  for (std::size_t n = first.value; n < model.nodes.size(); ++n)
    if (model.isOnAxis(NodeId(n))) model.nodes.held[n] |= kHeldX, model.nodes.velocity[n].x = 0;
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
  scratch_.places.clear();
  rebuild();
  watch.begin(energy(), ledger);
}

void World::bond(const CommonSides& sides, double strength, double energy) {
  fracture.bond(model, sides.pairs, strength, energy);
  stableStep = 0;
  scratch_.isBuilt = false;
}

}  // namespace yadefrag
