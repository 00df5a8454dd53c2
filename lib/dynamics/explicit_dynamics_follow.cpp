// What the time step keeps about the model, after nodes or triangles have changed.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "dynamics/explicit_dynamics.hpp"

namespace yadefrag {
namespace {

/// (m) Least height of all triangles, stress-free: 1/|∇Nᵢ| is the height on corner i.
double leastHeight(const Triangles& triangles) {
  double steepest = 0;  // 1/m²
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    if (triangles.isDropped(e)) continue;
    const auto& i = triangles.inverseEdges[e];
    const Vec2 second{i[0], i[1]}, third{i[2], i[3]}, first = -(second + third);
    steepest = std::max({steepest, dot(first, first), dot(second, second), dot(third, third)});
  }
  return 1 / std::sqrt(steepest);
}

}  // namespace

void ExplicitDynamics::rebuild(const Model& model) {
  elements_.build(model);
  watching_ = elements_.watch(leastStrength_);
  smoothing_.rebuild(elements_);
  flow_.rebuild(model, elements_);
  stressed_.clear();
  force_.assign(model.nodes.size(), {});
  partialForce_.resize(elements_.partials());
  viscousForce_.clear();
  partialViscous_.clear();
  previousPosition_ = model.nodes.position;
  previousVelocity_ = model.nodes.velocity;
  leastHeight_ = leastHeight(model.triangles);
  heldVelocity_.clear();
  heldNodes_.clear();
  bool holds = false;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes.held[n] == kFree) continue;
    holds = true;
    if (model.nodes.mass[n] != 0) heldNodes_.emplace_back(n);
  }
  if (holds) heldVelocity_ = model.nodes.velocity;
  scratch_.clear();
}

void ExplicitDynamics::reserve(std::size_t nodes) {
  force_.reserve(nodes);
  previousPosition_.reserve(nodes);
  previousVelocity_.reserve(nodes);
  if (!heldVelocity_.empty()) heldVelocity_.reserve(nodes);
  elements_.reserve(nodes);
}

std::size_t ExplicitDynamics::follow(const Model& model, std::span<const ElementId> changed,
                                     std::span<const NodeId> originals) {
  const NodeId firstNew(force_.size());
  assert(firstNew.value + originals.size() == model.nodes.size());
  std::vector<std::uint32_t> abandoned;
  const std::size_t chunks = elements_.follow(model, changed, firstNew, abandoned);
  for (std::vector<Vec2>* partial : {&partialForce_, &partialViscous_})
    if (!partial->empty()) {
      partial->resize(elements_.partials());
      for (const std::uint32_t i : abandoned) (*partial)[i] = {};
    }
  smoothing_.follow(elements_, abandoned);
  flow_.follow(elements_, abandoned);
  force_.resize(model.nodes.size());
  if (!viscousForce_.empty()) viscousForce_.resize(model.nodes.size());
  for (const NodeId original : originals) {
    previousPosition_.push_back(Vec2(previousPosition_[original.value]));
    previousVelocity_.push_back(Vec2(previousVelocity_[original.value]));
    if (model.nodes.held[original.value] != kFree)
      heldNodes_.emplace_back(previousPosition_.size() - 1);
    if (!heldVelocity_.empty()) heldVelocity_.push_back(Vec2(heldVelocity_[original.value]));
  }
  return chunks;
}

void ExplicitDynamics::drop(const Model& model, std::span<const NodeId> nodes) {
  if (heldVelocity_.empty()) return;
  for (const NodeId node : nodes) heldVelocity_[node.value] = {};
  std::erase_if(heldNodes_, [&](NodeId node) { return model.nodes.mass[node.value] == 0; });
}

void ExplicitDynamics::setStressLimits(std::vector<double> leastStrengthByComponent) {
  leastStrength_ = std::move(leastStrengthByComponent);
  watching_ = elements_.watch(leastStrength_);
}

}  // namespace yadefrag
