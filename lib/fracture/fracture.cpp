#include "fracture/fracture.hpp"

#include <algorithm>
#include <cassert>

#include "core/tolerances/fracture.hpp"
#include "dynamics/smoothed_state.hpp"
#include "fracture/yielding_split.hpp"

namespace yadefrag {

std::vector<EdgeId> Fracture::addBody(const Model& model, ComponentId component,
                                      const BrittlePlaces& places) {
  if (!model.components[component.value].brittle.cracks()) return {};
  return edges.addBody(model, component, places);
}

void Fracture::open(Model& model, const ContactSurfaces& surfaces, std::span<const EdgeId> joints,
                    SplitResult& result) {
  splitNodes(model, edges, surfaces, joints, result);
}

void Fracture::bond(const Model& model, std::span<const std::array<Side, 2>> sides, double strength,
                    double energy) {
  const std::size_t first = edges.size();
  edges.addBonds(model, sides, strength, energy);
  for (std::size_t i = first; i < edges.size(); ++i) cohesion.add(model, edges, EdgeId(i));
}

void Fracture::removeBody(const Model& model, ElementId first, ElementId last,
                          std::span<const NodeId> renumberedNodes) {
  // A brittle body of a single triangle has no edges, but its nodes must be registered.
  if (edges.ofNode.empty()) return;
  const std::vector<EdgeId> renumbered = edges.removeBody(model, first, last, renumberedNodes);
  cohesion.renumberEdges(renumbered);
  std::erase_if(overloads,
                [&](const Overload& one) { return renumbered[one.edge.value] == EdgeId::none(); });
  for (Overload& one : overloads) one.edge = renumbered[one.edge.value];
  started.resize(std::min(started.size(), renumbered.size()));
  for (std::size_t i = 0; i < started.size(); ++i)
    if (renumbered[i] != EdgeId::none()) started[renumbered[i].value] = started[i];
  started.resize(std::min(started.size(), edges.size()));
}

void Fracture::prepare(Model& model) {
  const std::size_t count = model.nodes.size();
  reserveRows(model.nodes.columns(), count + count / tolerance::kSpareNodes);
  edges.ofNode.reserve(count + count / tolerance::kSpareNodes);
  check_.prepare(model, edges);
}

bool Fracture::crack(Model& model, const ContactSurfaces& surfaces,
                     std::span<const ElementRange> where, const StepTime& step, SplitResult& result,
                     int threads) {
  cracks_.clear();
  weakened_.clear();
  hasRaised_ = false;
  yieldingGain_ = 0;
  if (where.empty() || numCracks_ >= maxCracks) {
    overloads.clear();
    return false;
  }
  weakened_ = check_.weaken(model, edges, where, step, leastStrength);
  cracks_ = check_.overstressed(model, edges, where, step, overloads, threads);
  if (cracks_.size() > maxCracks - numCracks_) cracks_.resize(maxCracks - numCracks_);
  if (cracks_.empty()) return false;
  numCracks_ += cracks_.size();
  hasRaised_ = check_.raise(model, edges, cracks_);
  std::erase_if(overloads,
                [&](const Overload& one) { return std::ranges::binary_search(cracks_, one.edge); });
  const YieldingSplit yielding(model, edges, cracks_, step.length);
  splitNodes(model, edges, surfaces, cracks_, result);
  check_.follow(model, edges, cracks_, result.originals);
  yieldingGain_ = yielding.settle(model, result.originals, step.length);
  return !result.sides.empty();
}

void Fracture::noteStart(double time) {
  if (cracks_.empty()) return;
  started.resize(edges.size(), -1);
  assert(cracks_.back().value < started.size());
  for (const EdgeId edge : cracks_) started[edge.value] = time;
}

double Fracture::splitEnergy(const Model& model, std::span<const NodeId> originals,
                             double dt) const {
  const std::size_t firstNew = model.nodes.size() - originals.size();
  std::vector<ElementId> fan;
  const auto sumAt = [&](NodeId node) {
    NodeSum sum;
    fan.clear();
    edges.appendFan(model, node, fan);
    for (const ElementId element : fan) sum.add(model, element, dt);
    return sum;
  };
  double gained = 0;
  // All parts of a node are consecutive.
  for (std::size_t i = 0; i < originals.size();) {
    const NodeId node = originals[i];
    const Component& body = model.components[model.nodes.component[node.value].value];
    if (body.element != ElementKind::kSmoothed || body.yields()) {
      ++i;
      continue;
    }
    NodeSum whole = sumAt(node);
    double parts = whole.energy(body.material);
    for (; i < originals.size() && originals[i] == node; ++i) {
      const NodeSum part = sumAt(NodeId(firstNew + i));
      parts += part.energy(body.material);
      whole += part;
    }
    gained += parts - whole.energy(body.material);
  }
  return gained;
}

void Fracture::cohere(const Model& model) {
  for (const EdgeId edge : cracks_)
    if (edges.fractureEnergy[edge.value] > 0) cohesion.add(model, edges, edge);
}

}  // namespace yadefrag
