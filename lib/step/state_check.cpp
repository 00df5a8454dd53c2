#include "mesh/material_constants.hpp"
#include "step/state.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace yadefrag {
namespace {

template <class Id>
bool allBelow(const std::vector<Id>& ids, std::size_t count) {
  return std::ranges::all_of(ids, [&](Id id) { return id.value < count; });
}

template <class Id>
bool allBelowOrNone(const std::vector<Id>& ids, std::size_t count) {
  return std::ranges::all_of(ids, [&](Id id) { return id == Id::none() || id.value < count; });
}

bool allFinite(const std::vector<Vec2>& values) { return std::ranges::all_of(values, isFinite); }

bool isPositive(double value) { return value > 0 && std::isfinite(value); }

/// True if `next` and `prev` are a permutation and its inverse.
template <class Id>
bool areLinks(const std::vector<Id>& next, const std::vector<Id>& prev) {
  const std::size_t count = next.size();
  if (prev.size() != count || !allBelow(next, count) || !allBelow(prev, count)) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (prev[next[i].value] != Id(i)) return false;
  return true;
}

bool materialIsValid(const BodyMaterial& one) {
  return elasticConstants().wrong(one.material).empty() && one.friction >= 0 &&
         std::isfinite(one.friction) && brittleConstants().wrong(one.brittle).empty() &&
         (!one.plastic.yields() || one.plastic.wrong().empty());
}

bool isValid(const Component& c, const Model& model) {
  return materialIsValid(c) && isPositive(c.thickness) && c.element <= ElementKind::kSmoothed &&
         !(c.isMixed() && c.element == ElementKind::kSmoothed) &&
         !(c.rigid && c.firstTriangle != c.lastTriangle) && c.firstTriangle <= c.lastTriangle &&
         c.lastTriangle <= model.triangles.size() && c.firstMaterial <= c.lastMaterial &&
         c.lastMaterial <= model.materials.size() &&
         !(c.isMixed() && model.triangles.material.empty());
}

bool componentsAreValid(const Model& model) {
  return std::ranges::all_of(model.components,
                             [&](const Component& c) { return isValid(c, model); }) &&
         std::ranges::all_of(model.materials, materialIsValid);
}

bool motionsAreValid(const Model& model) {
  const Nodes& n = model.nodes;
  return n.arm.size() == n.motion.size() && allFinite(n.arm) &&
         std::ranges::all_of(n.motion, [&](std::uint32_t m) { return m <= model.motions.size(); });
}

bool nodesAreValid(const WorldState& state) {
  const Nodes& n = state.model.nodes;
  return haveLength(n.columns(), n.size()) && allFinite(n.position) && allFinite(n.velocity) &&
         allFinite(n.load) && allFinite(n.reference) &&
         std::ranges::all_of(n.mass, [](double m) { return m >= 0 && std::isfinite(m); }) &&
         std::ranges::all_of(n.held, [](std::uint8_t h) { return h <= kHeldXY; }) &&
         allBelow(n.component, state.model.components.size()) && motionsAreValid(state.model);
}

/// Nodes of triangles that were not removed have a mass.
bool triangleIsValid(const Model& model, std::size_t element) {
  const Triangles& t = model.triangles;
  const auto& components = model.components;
  for (const NodeId node : t.nodes[element])
    if (node.value >= model.nodes.size() ||
        (!t.isDropped(element) && !(model.nodes.mass[node.value] > 0)))
      return false;
  const std::uint32_t body = t.component[element].value;
  if (body >= components.size()) return false;
  const std::uint32_t materials = components[body].lastMaterial - components[body].firstMaterial;
  if (materials > 0 && t.material[element] >= materials) return false;
  return element >= components[body].firstTriangle && element < components[body].lastTriangle &&
         t.area[element] >= 0 && std::isfinite(t.area[element]) &&
         (!model.axisymmetric || isPositive(t.radius[element])) &&
         std::ranges::all_of(t.inverseEdges[element], [](double v) { return std::isfinite(v); });
}

/// Bodies that yield or fail have a state.
bool yieldingIsValid(const Model& model) {
  const PlasticState& state = model.triangles.plastic;
  const auto any = [&](bool (Component::*has)() const) {
    return std::ranges::any_of(model.components, has);
  };
  return (state.isUsed() || !any(&Component::yields)) &&
         (!state.damage.empty() || !any(&Component::fails)) &&
         std::ranges::all_of(state.damage, [](double d) { return d >= 0 && d <= 1; }) &&
         std::ranges::all_of(state.resistance, [](double r) { return r > 0 && std::isfinite(r); });
}

bool trianglesAreValid(const Model& model) {
  const Triangles& t = model.triangles;
  const std::size_t count = t.size();
  if (!haveLength(t.columns(), count)) return false;
  if (t.radius.size() != (model.axisymmetric ? count : 0)) return false;
  if (!yieldingIsValid(model)) return false;
  for (std::size_t e = 0; e < count; ++e)
    if (!triangleIsValid(model, e)) return false;
  return true;
}

bool segmentsAreValid(const WorldState& state) {
  const ContactSurfaces& s = state.surfaces;
  const std::size_t count = s.segments();
  return haveLength(s.segmentColumns(), count) && areLinks(s.segmentNext, s.segmentPrev) &&
         allBelow(s.segmentEntry, s.entries()) &&
         s.nodeSegment.size() <= state.model.nodes.size() && allBelowOrNone(s.nodeSegment, count) &&
         allBelow(s.segmentNode, s.nodeSegment.size());
}

bool entriesAreValid(const WorldState& state) {
  const ContactSurfaces& s = state.surfaces;
  const std::size_t count = s.entries();
  return haveLength(s.entryColumns(), count) && areLinks(s.next, s.prev) &&
         allBelow(s.entrySegment, s.segments()) &&
         allBelow(s.component, state.model.components.size()) &&
         std::ranges::all_of(s.piece, [](Piece p) { return p <= Piece::kGone; }) &&
         std::ranges::all_of(s.loop, [&](std::uint32_t l) { return l <= count; });
}

bool loadsAreValid(const WorldState& state) {
  const std::size_t count = state.surfaces.segments();
  return allBelow(state.loads.absorbing.segments, count) &&
         std::ranges::all_of(state.loads.pressures, [&](const Pressure& p) {
           const bool staysOut = p.firstNew == Pressure::kNever;
           return allBelow(p.segments, count) && (staysOut || p.firstNew <= count);
         });
}

bool contactIsValid(const WorldState& state) {
  const Candidates& c = state.contact.candidates;
  const std::size_t entries = state.surfaces.entries();
  const bool offsetsFit = c.offsets.empty()
                              ? c.slaves.empty() && c.masters.empty()
                              : c.offsets.size() == c.slaves.size() + 1 && c.offsets.front() == 0 &&
                                    c.offsets.back() == c.masters.size() &&
                                    std::ranges::is_sorted(c.offsets);
  return offsetsFit && allBelow(c.slaves, entries) && allBelow(c.masters, entries) &&
         std::ranges::all_of(state.contact.touches, [&](const StoredContact& t) {
           return t.pair.slave.value < entries && t.pair.master.value < entries;
         });
}

bool searchIsValid(const WorldState& state) {
  const SearchState& s = state.search;
  return s.halo >= 0 && std::isfinite(s.halo) && allBelow(s.nodes, state.model.nodes.size()) &&
         (s.isVoid() || s.positions.size() == s.nodes.size()) && allFinite(s.positions) &&
         s.loaded.farthest >= 0 && s.loaded.speed >= 0;
}

bool edgesAreValid(const WorldState& state) {
  const CrackEdges& e = state.fracture.edges;
  const std::size_t count = e.size(), triangles = state.model.triangles.size();
  if (!haveLength(e.columns(), count) || e.ofElement.size() > triangles ||
      e.ofNode.size() > state.model.nodes.size() || !allBelowOrNone(e.ofNode, triangles))
    return false;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t element = e.element[i][k].value;
      if (element >= e.ofElement.size() || e.corner[i][k] > 2 ||
          e.ofElement[element][e.corner[i][k]] != EdgeId(i))
        return false;
    }
  if (!std::ranges::all_of(e.strength, isPositive) ||
      !std::ranges::all_of(e.fractureEnergy, [](double g) { return g >= 0 && std::isfinite(g); }))
    return false;
  return std::ranges::all_of(e.ofElement, [&](const std::array<EdgeId, 3>& edges) {
    return std::ranges::all_of(
        edges, [&](EdgeId edge) { return edge == EdgeId::none() || edge.value < count; });
  });
}

bool overloadsAreValid(const Fracture& fracture) {
  return std::ranges::is_sorted(fracture.overloads, {}, &Overload::edge) &&
         std::ranges::all_of(fracture.overloads, [&](const Overload& one) {
           return one.edge.value < fracture.edges.size() && std::isfinite(one.since);
         });
}

bool fractureIsValid(const WorldState& state) {
  const Cohesion& c = state.fracture.cohesion;
  return edgesAreValid(state) && state.fracture.started.size() <= state.fracture.edges.size() &&
         overloadsAreValid(state.fracture) &&
         std::ranges::none_of(state.fracture.started, [](double t) { return std::isnan(t); }) &&
         haveLength(c.columns(), c.edge.size()) && allBelow(c.edge, state.fracture.edges.size());
}

}  // namespace

std::string findInvalidPart(const WorldState& state) {
  if (!componentsAreValid(state.model)) return "a body's values";
  if (!nodesAreValid(state)) return "its nodes";
  if (!trianglesAreValid(state.model)) return "its triangles";
  if (!segmentsAreValid(state) || !entriesAreValid(state)) return "its boundaries";
  if (!loadsAreValid(state)) return "its loads";
  if (!contactIsValid(state)) return "its contacts";
  if (!searchIsValid(state)) return "its search data";
  if (!fractureIsValid(state)) return "its cracks";
  return {};
}

}  // namespace yadefrag
