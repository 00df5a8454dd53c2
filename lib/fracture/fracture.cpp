#include "fracture/fracture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/arrays.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/fracture.hpp"
#include "elements/element_state.hpp"
#include "fracture/edge_strength.hpp"

namespace yadefrag {

namespace {

/// All triangles at some nodes, ascending.
std::vector<ElementId> trianglesAt(const Model& model, const CrackEdges& edges,
                                   const std::vector<NodeId>& nodes) {
  std::vector<ElementId> triangles;
  for (const NodeId node : nodes) edges.appendFan(model, node, triangles);
  sortUnique(triangles);
  return triangles;
}

/// J of a triangle by itself.
double ratioOf(const Model& model, ElementId element) {
  return determinant(elasticGradient(model, element)) *
         model.triangles.plastic.thickness[element.value] * hoopStretch(model, element);
}

/// (m²; m³ with an axis) By which ratios are averaged at a node.
double weightOf(const Model& model, ElementId element, NodeId node) {
  if (!model.axisymmetric) return model.triangles.area[element.value];
  const auto corner = static_cast<std::size_t>(cornerOf(model, element, node));
  return volumeOf(model, element) * model.massShare(element, corner);
}

/// Changes the stress-free volume; the same factor in all directions keeps the deviator.
void setRatio(Model& model, ElementId element, double ratio) {
  const double factor = std::cbrt(ratio / ratioOf(model, element));
  YieldPoint point(model.triangles.plastic, element.value);
  for (double& one : point.edges) one *= factor;
  point.thickness *= factor;
  point.put(model.triangles.plastic, element.value);
}

/// Bodies that yield and whose volume strain is averaged at the nodes, where nodes split. The parts
/// of a node would have other means than the node, since the volume strains of single triangles
/// oscillate, without energy, about those of their nodes: the split would create energy. So the
/// stress-free volumes of the triangles around are changed such that each part nearly keeps the
/// mean of its node. What cannot be kept, as in a fragment of one triangle, is gained or lost.
class YieldingSplit {
 public:
  /// Before the split, which will crack these edges.
  YieldingSplit(const Model& model, const CrackEdges& edges, std::span<const EdgeId> cracks,
                double dt);
  /// After the split; `originals` as in SplitResult. Returns the energy (J) that these bodies have
  /// gained, at the half step.
  double applySplit(Model& model, std::span<const NodeId> originals, double dt) const;

 private:
  struct Sum;
  [[nodiscard]] std::vector<Sum> sumsOf(const Model& model, std::span<const NodeId> originals,
                                        const std::vector<double>& ratio) const;

  std::vector<ElementId> around_;  // triangles that may change, ascending
  std::vector<ElementId> wide_;    // all at their nodes: those whose energy may change
  std::vector<NodeId> nodes_;      // of which all triangles are among these, ascending
  std::vector<double> mean_;       // of these nodes, J
  double before_ = 0;              // J
};

/// A node, or a part of one: the sum of A J over its triangles is to be `wanted`.
struct YieldingSplit::Sum {
  struct Share {
    std::size_t triangle;  // place in around_
    double area;           // m²
  };
  std::vector<Share> triangles;
  double area = 0;     // m²
  double squared = 0;  // m⁴, ΣA²
  double wanted = 0;   // m²
};

YieldingSplit::YieldingSplit(const Model& model, const CrackEdges& edges,
                             std::span<const EdgeId> cracks, double dt) {
  for (const EdgeId edge : cracks) {
    const Side side = edges.side(edge, 0);
    if (!model.bodyOf(side.element).averagesVolume()) continue;
    nodes_.push_back(firstNode(model, side));
    nodes_.push_back(lastNode(model, side));
  }
  if (nodes_.empty()) return;
  sortUnique(nodes_);
  for (const ElementId element : trianglesAt(model, edges, nodes_))
    for (const NodeId node : model.triangles.nodes[element.value]) nodes_.push_back(node);
  sortUnique(nodes_);
  around_ = trianglesAt(model, edges, nodes_);
  std::vector<NodeId> corners;
  for (const ElementId element : around_)
    for (const NodeId node : model.triangles.nodes[element.value]) corners.push_back(node);
  sortUnique(corners);
  wide_ = trianglesAt(model, edges, corners);
  before_ = yieldingEnergy(model, wide_, dt).strain;
  std::vector<double> area(nodes_.size()), sum(nodes_.size());
  for (const ElementId e : around_)
    for (const NodeId node : model.triangles.nodes[e.value]) {
      const auto at = std::ranges::lower_bound(nodes_, node);
      if (at == nodes_.end() || *at != node) continue;
      const auto i = static_cast<std::size_t>(at - nodes_.begin());
      const double weight = weightOf(model, e, node);
      area[i] += weight;
      sum[i] += weight * ratioOf(model, e);
    }
  for (std::size_t i = 0; i < nodes_.size(); ++i) mean_.push_back(sum[i] / area[i]);
}

/// The sums at all nodes of the triangles around, now that nodes have split.
auto YieldingSplit::sumsOf(const Model& model, std::span<const NodeId> originals,
                           const std::vector<double>& ratio) const -> std::vector<Sum> {
  std::vector<NodeId> present;
  for (const ElementId e : around_)
    for (const NodeId node : model.triangles.nodes[e.value]) present.push_back(node);
  sortUnique(present);
  std::vector<Sum> sums(present.size());
  for (std::size_t t = 0; t < around_.size(); ++t)
    for (const NodeId node : model.triangles.nodes[around_[t].value]) {
      const auto at = std::ranges::lower_bound(present, node) - present.begin();
      const double area = weightOf(model, around_[t], node);
      Sum& sum = sums[static_cast<std::size_t>(at)];
      sum.triangles.push_back({t, area});
      sum.area += area, sum.squared += area * area, sum.wanted += area * ratio[t];
    }
  const std::size_t firstNew = model.nodes.size() - originals.size();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const NodeId whole =
        present[i].value < firstNew ? present[i] : originals[present[i].value - firstNew];
    const auto at = std::ranges::lower_bound(nodes_, whole);
    // Of other nodes not all triangles are known: their sum must not change.
    if (at != nodes_.end() && *at == whole)
      sums[i].wanted = sums[i].area * mean_[static_cast<std::size_t>(at - nodes_.begin())];
  }
  return sums;
}

double YieldingSplit::applySplit(Model& model, std::span<const NodeId> originals, double dt) const {
  if (around_.empty()) return 0;
  std::vector<double> ratio;
  for (const ElementId e : around_) ratio.push_back(ratioOf(model, e));
  const std::vector<Sum> sums = sumsOf(model, originals, ratio);
  // Kaczmarz's method, relaxed: near to the nearest solution, and bounded where there is none.
  for (int sweep = 0; sweep < tolerance::kVolumeSweeps; ++sweep)
    for (const Sum& sum : sums) {
      double now = 0;
      for (const auto& [t, area] : sum.triangles) now += area * ratio[t];
      const double by = tolerance::kVolumeShare * (sum.wanted - now) / sum.squared;
      for (const auto& [t, area] : sum.triangles) ratio[t] += by * area;
    }
  for (std::size_t t = 0; t < around_.size(); ++t)
    if (ratio[t] > 0) setRatio(model, around_[t], ratio[t]);
  return yieldingEnergy(model, wide_, dt).strain - before_;
}

}  // namespace

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
  raiseEnergies(model, step.end);
  std::erase_if(overloads,
                [&](const Overload& one) { return std::ranges::binary_search(cracks_, one.edge); });
  const YieldingSplit yielding(model, edges, cracks_, step.length);
  splitNodes(model, edges, surfaces, cracks_, result);
  check_.follow(model, edges, cracks_, result.originals);
  yieldingGain_ = yielding.applySplit(model, result.originals, step.length);
  return !result.sides.empty();
}

/// (m/s) Of a crack at an edge: the way from the middle of the edge from which it comes, over the
/// time between both starts. That is the edge with a common node that has cracked first: those at
/// the side of the tip crack at nearly the same time. Without one the edge is the begin of a crack:
/// slow.
double Fracture::speedAt(const Model& model, EdgeId edge, double now) const {
  const auto ends = [&](EdgeId of) {
    const Side side = edges.side(of, 0);
    return std::array{firstNode(model, side), lastNode(model, side)};
  };
  const auto middle = [&](EdgeId of) {
    const auto [a, b] = ends(of);
    return .5 * (model.nodes.reference[a.value] + model.nodes.reference[b.value]);
  };
  double since = now;
  EdgeId from;
  std::vector<ElementId> fan;
  for (const NodeId node : ends(edge)) {
    fan.clear();
    edges.appendFan(model, node, fan);
    edges.forEdgesAt(model, node, fan, [&](EdgeId other) {
      const double start = other.value < started.size() ? started[other.value] : -1;
      if (start >= 0 && start < since) since = start, from = other;
    });
  }
  return since < now ? norm(middle(edge) - middle(from)) / (now - since) : 0;
}

void Fracture::raiseEnergies(const Model& model, double now) {
  for (const EdgeId edge : cracks_) {
    const auto [first, second] = edges.element[edge.value];
    const RateEffect& effect = materialBetween(model, first, second).brittle.speed;
    if (effect.isOn()) edges.fractureEnergy[edge.value] *= effect.factor(speedAt(model, edge, now));
  }
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
    for (const ElementId element : fan) {
      const auto corner = static_cast<std::size_t>(cornerOf(model, element, node));
      sum.add(model, element, model.massShare(element, corner), dt);
    }
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

void Fracture::applyCohesion(const Model& model) {
  for (const EdgeId edge : cracks_)
    if (edges.fractureEnergy[edge.value] > 0) cohesion.add(model, edges, edge);
}

}  // namespace yadefrag
