#include "fracture/yielding_split.hpp"

#include <algorithm>
#include <cmath>

#include "core/arrays.hpp"
#include "core/tolerances/plasticity.hpp"
#include "dynamics/element_state.hpp"
#include "dynamics/yielding_state.hpp"

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
         model.triangles.plastic.thickness[element.value];
}

/// Changes the stress-free volume; the same factor in all directions keeps the deviator.
void setRatio(Model& model, ElementId element, double ratio) {
  const double factor = std::cbrt(ratio / ratioOf(model, element));
  YieldPoint point(model.triangles.plastic, element.value);
  for (double& one : point.edges) one *= factor;
  point.thickness *= factor;
  point.put(model.triangles.plastic, element.value);
}

}  // namespace

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
      area[i] += model.triangles.area[e.value];
      sum[i] += model.triangles.area[e.value] * ratioOf(model, e);
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
      const double area = model.triangles.area[around_[t].value];
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

double YieldingSplit::settle(Model& model, std::span<const NodeId> originals, double dt) const {
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

}  // namespace yadefrag
