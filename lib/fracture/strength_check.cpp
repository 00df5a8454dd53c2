#include "fracture/strength_check.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/tolerances/fracture.hpp"
#include "elements/element_state.hpp"
#include "fracture/edge_strength.hpp"
#include "fracture/separation.hpp"

namespace yadefrag {
namespace {

bool haveSeveralMaterials(const Model& model, std::span<const ElementId> elements) {
  if (!model.bodyOf(elements.front()).isMixed()) return false;
  const auto number = [&](ElementId e) { return model.triangles.material[e.value]; };
  return std::ranges::any_of(elements,
                             [&](ElementId e) { return number(e) != number(elements.front()); });
}

/// Calls `visit(edge)` for the edges at a node that have not cracked, for most of them twice.
/// `fan`: the triangles there.
template <class Visit>
void forWholeEdges(const Model& model, const CrackEdges& edges, std::span<const ElementId> fan,
                   NodeId node, Visit visit) {
  edges.forEdgesAt(model, node, fan, [&](EdgeId edge) {
    if (edges.cracked[edge.value] == 0) visit(edge);
  });
}

/// Of both ends of an edge.
std::array<double, 3> meanOf(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {.5 * (a[0] + b[0]), .5 * (a[1] + b[1]), .5 * (a[2] + b[2])};
}

}  // namespace

std::vector<EdgeId> StrengthCheck::overstressed(const Model& model, const CrackEdges& edges,
                                                std::span<const ElementRange> where,
                                                const StepTime& step,
                                                std::vector<Overload>& overloads, int threads) {
  resize(model, edges);
  ++call_;
  found_.clear();
  over_.clear();
  step_ = step;
  former_ = overloads;
  listNodes(model, where, threads);
  computeStresses(model, edges, threads);
  listWeak(model, edges, threads);
  for (const NodeId node : weak_) checkEdges(model, edges, node);
  std::ranges::sort(over_, {}, &Overload::edge);
  overloads.swap(over_);
  return pickApart(model, edges);
}

/// The nodes of these triangles at which an edge may have reached its strength.
void StrengthCheck::listNodes(const Model& model, std::span<const ElementRange> where,
                              int threads) {
  listInParts(where.size(), threads, parts_, nodes_,
              [&](std::size_t begin, std::size_t end, auto& list) {
                for (std::size_t i = begin; i < end; ++i)
                  for (std::uint32_t e = where[i].firstElement; e < where[i].lastElement; ++e)
                    if (!model.triangles.isDropped(e)) listCorners(model, ElementId(e), list);
              });
  std::erase_if(
      nodes_, [&](NodeId node) { return std::exchange(nodeTested_[node.value], call_) == call_; });
}

/// Most stressed elements in rubble have no edge left that could crack. The largest traction is a
/// convex function of the stress: where a mean over elements reaches the strength of an edge, one
/// of them does.
void StrengthCheck::listCorners(const Model& model, ElementId element, std::vector<NodeId>& list) {
  const auto& nodes = model.triangles.nodes[element.value];
  const auto weakestAt = [&](NodeId node) { return weakest_[node.value]; };
  const double weakest = std::min({weakestAt(nodes[0]), weakestAt(nodes[1]), weakestAt(nodes[2])});
  if (weakest == INFINITY) return;
  const Law& law = laws_[model.triangles.component[element.value].value];
  double squared = INFINITY;
  if (!law.mayHold && !law.isMixed) squared = squaredBound(law.bound, stressOf(model, element));
  for (const NodeId node : nodes) {
    const double nearly = tolerance::kNearlyStrength * weakestAt(node);
    if (nearly < INFINITY && squared >= nearly * nearly) list.push_back(node);
  }
}

/// Those of all triangles around the listed nodes.
void StrengthCheck::computeStresses(const Model& model, const CrackEdges& edges, int threads) {
  around_.clear();
  for (const NodeId node : nodes_)
    for (const ElementId element : elementsOf(fanAt(model, edges, node)))
      if (std::exchange(elementSeen_[element.value], call_) != call_) around_.push_back(element);
  forEachPart(around_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      elementStress_[around_[i].value] = computeStress(model, around_[i]);
  });
}

void StrengthCheck::listWeak(const Model& model, const CrackEdges& edges, int threads) {
  listInParts(nodes_.size(), threads, parts_, weak_,
              [&](std::size_t begin, std::size_t end, auto& list) {
                for (std::size_t i = begin; i < end; ++i)
                  if (mayCrackAt(model, edges, nodes_[i])) list.push_back(nodes_[i]);
              });
}

/// At one end of an edge, at least, the traction is not less than their mean: the ends are tested
/// first. Where materials meet, a node's mean is not that of its edges.
bool StrengthCheck::mayCrackAt(const Model& model, const CrackEdges& edges, NodeId node) {
  const Law& law = laws_[model.nodes.component[node.value].value];
  const double nearly = tolerance::kNearlyStrength * weakest_[node.value];
  if (squaredBound(law.bound, stressAt(model, edges, node)) >= nearly * nearly) return true;
  const Fan& fan = fanOf_[node.value];
  if (!law.mayHold || (fan.isRing && !law.isMixed)) return false;
  return haveSeveralMaterials(model, elementsOf(fan)) || isTipAt(model, edges, node);
}

void StrengthCheck::checkEdges(const Model& model, const CrackEdges& edges, NodeId node) {
  // A copy: the fans of other nodes are added below.
  const std::span<const ElementId> fan = elementsOf(fanAt(model, edges, node));
  around_.assign(fan.begin(), fan.end());
  forWholeEdges(model, edges, around_, node, [&](EdgeId edge) {
    if (std::exchange(edgeSeen_[edge.value], call_) == call_) return;
    const Overstressed one = compare(model, edges, edge);
    if (one.ratio >= 1) found_.push_back(one);
  });
}

void StrengthCheck::prepare(const Model& model, const CrackEdges& edges) {
  laws_.clear();
  for (const Component& body : model.components)
    laws_.push_back({Moduli(body.material), TractionBound(body.brittle.shearFactor, body.friction),
                     !body.isMixed() && !body.yields(),
                     body.brittle.fractureEnergy > 0 || body.brittleByPlace, body.isMixed()});
  weakest_.assign(model.nodes.size(), INFINITY);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.cracked[e] != 0) continue;
    const Side side = edges.side(EdgeId(e), 0);
    for (const NodeId node : {firstNode(model, side), lastNode(model, side)})
      weakest_[node.value] = std::min(weakest_[node.value], edges.strength[e]);
  }
  fanOf_.assign(model.nodes.size(), {});
  fans_.clear();
  resize(model, edges);
}

void StrengthCheck::follow(const Model& model, const CrackEdges& edges,
                           std::span<const EdgeId> cracks, std::span<const NodeId> originals) {
  weakest_.resize(model.nodes.size());
  fanOf_.resize(model.nodes.size());
  for (const EdgeId edge : cracks)
    for (const int which : {0, 1}) {
      update(model, edges, firstNode(model, edges.side(edge, which)));
      update(model, edges, lastNode(model, edges.side(edge, which)));
    }
  const std::size_t firstNew = model.nodes.size() - originals.size();
  for (std::size_t i = 0; i < originals.size(); ++i) {
    update(model, edges, originals[i]);
    update(model, edges, NodeId(firstNew + i));
  }
}

/// After a crack at the node.
void StrengthCheck::update(const Model& model, const CrackEdges& edges, NodeId node) {
  fan_.clear();
  Fan& fan = fanOf_[node.value];
  fan.isRing = edges.appendFan(model, node, fan_);
  // A fan never grows: it keeps its place.
  assert(fan.begin == kUnknown || fan_.size() <= fan.count);
  if (fan.begin == kUnknown) {
    fan.begin = static_cast<std::uint32_t>(fans_.size());
    fans_.resize(fans_.size() + fan_.size());
  }
  fan.count = static_cast<std::uint32_t>(fan_.size());
  std::ranges::copy(fan_, fans_.begin() + fan.begin);
  double least = INFINITY;
  forWholeEdges(model, edges, fan_, node,
                [&](EdgeId edge) { least = std::min(least, edges.strength[edge.value]); });
  weakest_[node.value] = least;
}

/// Its elements may be in another place after the next call.
StrengthCheck::Fan& StrengthCheck::fanAt(const Model& model, const CrackEdges& edges, NodeId node) {
  Fan& fan = fanOf_[node.value];
  if (fan.begin == kUnknown) {
    fan.begin = static_cast<std::uint32_t>(fans_.size());
    fan.isRing = edges.appendFan(model, node, fans_);
    fan.count = static_cast<std::uint32_t>(fans_.size()) - fan.begin;
  }
  return fan;
}

/// True at the tip of a notch or a crack.
bool StrengthCheck::isTipAt(const Model& model, const CrackEdges& edges, NodeId node) {
  Fan& fan = fanAt(model, edges, node);
  if (fan.isRing) return false;
  if (std::exchange(fan.tested, call_) != call_) fan.isTip = isTip(model, elementsOf(fan), node);
  return fan.isTip;
}

void StrengthCheck::resize(const Model& model, const CrackEdges& edges) {
  elementSeen_.resize(model.triangles.size());
  elementStress_.resize(model.triangles.size());
  const std::size_t room = model.nodes.position.capacity();
  for (auto* marks : {&nodeSeen_, &nodeTaken_, &nodeTested_}) marks->reserve(room);
  nodeStress_.reserve(room);
  nodeSeen_.resize(model.nodes.size());
  nodeStress_.resize(model.nodes.size());
  weakest_.reserve(room);
  fanOf_.reserve(room);
  nodeTaken_.resize(model.nodes.size());
  nodeTested_.resize(model.nodes.size());
  edgeSeen_.resize(edges.size());
}

StrengthCheck::Stress StrengthCheck::computeStress(const Model& model, ElementId element) const {
  const Law& law = laws_[model.triangles.component[element.value].value];
  return law.isElastic ? elasticStressOf(model, element, law.moduli)
                       : yadefrag::stressOf(model, element, step_.length);
}

const StrengthCheck::Stress& StrengthCheck::stressOf(const Model& model, ElementId element) {
  Stress& stress = elementStress_[element.value];
  if (elementSeen_[element.value] == call_) return stress;
  elementSeen_[element.value] = call_;
  return stress = computeStress(model, element);
}

const StrengthCheck::Stress& StrengthCheck::stressAt(const Model& model, const CrackEdges& edges,
                                                     NodeId node) {
  Stress& mean = nodeStress_[node.value];
  if (nodeSeen_[node.value] == call_) return mean;
  nodeSeen_[node.value] = call_;
  return mean = meanAt(
             model, edges, node, [](ElementId) { return true; },
             [&](ElementId e) { return stressOf(model, e); });
}

/// Value at an end of an edge: the mean over the triangles with one of the edge's two materials.
template <class Of>
std::array<double, 3> StrengthCheck::meanOfMaterials(const Model& model, const CrackEdges& edges,
                                                     EdgeId edge, NodeId node, Of of) {
  const auto number = [&](ElementId e) { return model.triangles.material[e.value]; };
  const auto [a, b] = edges.element[edge.value];
  const std::uint32_t first = number(a), second = number(b);
  return meanAt(
      model, edges, node, [&](ElementId e) { return number(e) == first || number(e) == second; },
      of);
}

/// Mean by area over the triangles of a node's fan for which `counts` is true.
template <class Counts, class Of>
std::array<double, 3> StrengthCheck::meanAt(const Model& model, const CrackEdges& edges,
                                            NodeId node, Counts counts, Of of) {
  std::array<double, 3> mean{};
  double whole = 0;
  for (const ElementId element : elementsOf(fanAt(model, edges, node))) {
    if (!counts(element)) continue;
    const double area = model.triangles.area[element.value];
    const std::array<double, 3> value = of(element);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += area * value[i];
    whole += area;
  }
  assert(whole > 0);
  for (double& component : mean) component /= whole;
  return mean;
}

/// (1/s) Rate of the strain at an edge with this mean stress, in the direction of its largest
/// principal value.
double StrengthCheck::strainRateAt(const Model& model, const CrackEdges& edges, EdgeId edge,
                                   const Stress& stress) {
  const Side side = edges.side(edge, 0);
  const bool isMixed = model.bodyOf(side.element).isMixed();
  const auto rateOf = [&](ElementId e) { return strainRateOf(model, e); };
  const auto at = [&](NodeId node) {
    if (isMixed) return meanOfMaterials(model, edges, edge, node, rateOf);
    return meanAt(
        model, edges, node, [](ElementId) { return true; }, rateOf);
  };
  return strainRateAlong(stress, meanOf(at(firstNode(model, side)), at(lastNode(model, side))));
}

/// (Pa) At an edge: the mean of its ends.
StrengthCheck::Stress StrengthCheck::stressAcross(const Model& model, const CrackEdges& edges,
                                                  EdgeId edge) {
  const Side side = edges.side(edge, 0);
  const bool isMixed = model.bodyOf(side.element).isMixed();
  const auto at = [&](NodeId node) -> Stress {
    if (!isMixed) return stressAt(model, edges, node);
    return meanOfMaterials(model, edges, edge, node,
                           [&](ElementId e) { return stressOf(model, e); });
  };
  return meanOf(at(firstNode(model, side)), at(lastNode(model, side)));
}

/// The traction on an edge over its strength.
StrengthCheck::Overstressed StrengthCheck::compare(const Model& model, const CrackEdges& edges,
                                                   EdgeId edge) {
  const Side side = edges.side(edge, 0);
  const NodeId a = firstNode(model, side), b = lastNode(model, side);
  const Stress mean = stressAcross(model, edges, edge);
  const Traction traction = tractionOn(mean, normalOf(model, edges, edge));
  const auto [first, second] = edges.element[edge.value];
  const auto [brittle, friction] = materialBetween(model, first, second);
  double most = effectiveTraction(traction.normal, traction.shear, brittle, friction);
  if (edges.fractureEnergy[edge.value] > 0)
    for (const NodeId end : {a, b}) most = std::max(most, tractionAtTip(model, edges, edge, end));
  const double ratio = most / edges.strength[edge.value];
  if (!brittle.rate.isOn() || ratio < 1) return {ratio, edge, 1};
  const double factor = factorAt(model, edges, edge, ratio, mean);
  return {ratio / factor, edge, factor};
}

/// Factor of the strength by the mean strain rate of an edge's overload. `ratio`: the traction over
/// the strength in slow tests, at least 1.
double StrengthCheck::factorAt(const Model& model, const CrackEdges& edges, EdgeId edge,
                               double ratio, const Stress& stress) {
  const auto [a, b] = edges.element[edge.value];
  const double strain = (ratio - 1) * edges.strength[edge.value] / modulusBetween(model, a, b);
  const auto former = std::ranges::lower_bound(former_, edge, {}, &Overload::edge);
  double lasted = step_.length;
  if (former != former_.end() && former->edge == edge) {
    lasted = step_.end - former->since;
  } else {
    // It began within this step, at the present rate of the strain.
    const double rate = strainRateAt(model, edges, edge, stress);
    if (strain < rate * lasted) lasted = strain / rate;
  }
  over_.push_back({edge, step_.end - lasted});
  return materialBetween(model, a, b).brittle.rate.factor(lasted > 0 ? strain / lasted : 0);
}

bool StrengthCheck::raise(const Model& model, CrackEdges& edges,
                          std::span<const EdgeId> cracks) const {
  assert(std::ranges::is_sorted(cracks));
  bool any = false;
  for (const Overstressed& one : found_) {
    if (one.factor == 1 || !std::ranges::binary_search(cracks, one.edge)) continue;
    const auto [a, b] = edges.element[one.edge.value];
    edges.strength[one.edge.value] *= one.factor;
    edges.fractureEnergy[one.edge.value] *=
        std::pow(one.factor, materialBetween(model, a, b).brittle.rateEnergyPower);
    any = true;
  }
  return any;
}

/// (Pa) Effective traction at the tip of a notch or a crack; 0 at any other node. Shear counts only
/// if no other edge there is about to open: a crack that slides in solid material turns.
double StrengthCheck::tractionAtTip(const Model& model, const CrackEdges& edges, EdgeId edge,
                                    NodeId node) {
  if (model.nodes.held[node.value] != kFree) return 0;
  if (!isTipAt(model, edges, node)) return 0;
  const std::span<const ElementId> fan = elementsOf(fanAt(model, edges, node));
  const Traction traction = tipTraction(model, edges, edge, node, fan);
  const double strength = edges.strength[edge.value];
  if (traction.normal >= strength) return traction.normal;
  const auto [first, second] = edges.element[edge.value];
  const auto [brittle, friction] = materialBetween(model, first, second);
  const double both = effectiveTraction(traction.normal, traction.shear, brittle, friction);
  if (both < strength) return traction.normal;
  const double other = otherPull(model, edges, edge, node, fan);
  return both >= tolerance::kShearLead * other * strength ? both : traction.normal;
}

std::vector<EdgeId> StrengthCheck::pickApart(const Model& model, const CrackEdges& edges) {
  std::sort(found_.begin(), found_.end(), [](const Overstressed& a, const Overstressed& b) {
    return a.ratio != b.ratio ? a.ratio > b.ratio : a.edge < b.edge;
  });
  std::vector<EdgeId> picked;
  for (const Overstressed& one : found_) {
    const Side side = edges.side(one.edge, 0);
    if (edges.fractureEnergy[one.edge.value] == 0) {
      std::uint32_t& first = nodeTaken_[firstNode(model, side).value];
      std::uint32_t& last = nodeTaken_[lastNode(model, side).value];
      if (first == call_ || last == call_) continue;
      first = last = call_;
    }
    picked.push_back(one.edge);
  }
  std::sort(picked.begin(), picked.end());
  assert(std::ranges::adjacent_find(picked) == picked.end());
  return picked;
}

}  // namespace yadefrag
