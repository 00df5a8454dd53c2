// StrengthCheck: strength of the edges of triangles whose material has failed.

#include <algorithm>
#include <cmath>

#include "core/arrays.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/element_state.hpp"
#include "fracture/separation.hpp"
#include "fracture/strength_check.hpp"

namespace yadefrag {

void StrengthCheck::weakenAround(const Model& model, const CrackEdges& edges, ElementId element) {
  std::array<EdgeId, 3> own;
  std::size_t count = 0;
  double most = 0;
  bool isNew = false;
  for (const EdgeId edge : edges.ofElement[element.value]) {
    if (edge == EdgeId::none() || edges.cracked[edge.value] != 0) continue;
    own[count++] = edge;
    isNew = isNew || edges.strength[edge.value] == kUnbreakable;
  }
  if (!isNew) return;
  const Component& body = model.bodyOf(element);
  for (std::size_t i = 0; i < count; ++i) {
    const Traction t =
        tractionOn(stressAcross(model, edges, own[i]), normalOf(model, edges, own[i]));
    most = std::max(most, effectiveTraction(t.normal, t.shear, body.brittle, body.friction));
  }
  const Returned now = presentState(model, element, step_.length);
  const double mises =
      SolidModuli(body.material).shear * now.kept * std::sqrt(now.trial.squaredMises());
  if (!(most > tolerance::kLeastOpening * mises)) return;
  for (std::size_t i = 0; i < count; ++i) weakened_.push_back({own[i], most});
}

std::vector<EdgeId> StrengthCheck::weaken(const Model& model, CrackEdges& edges,
                                          std::span<const ElementRange> where, const StepTime& step,
                                          std::vector<double>& leastStrength) {
  if (model.triangles.plastic.damage.empty()) return {};
  resize(model, edges);
  ++call_;
  step_ = step;
  weakened_.clear();
  for (const ElementRange& range : where)
    for (std::uint32_t e = range.firstElement; e < range.lastElement; ++e)
      if (!model.triangles.isDropped(e) && model.triangles.plastic.hasFailed(e))
        weakenAround(model, edges, ElementId(e));
  std::vector<EdgeId> changed;
  for (const Weakened& one : weakened_) {
    double& strength = edges.strength[one.edge.value];
    strength = std::min(strength, one.strength);
    double& least =
        leastStrength[model.triangles.component[edges.element[one.edge.value][0].value].value];
    least = std::min(least, strength);
    const Side side = edges.side(one.edge, 0);
    for (const NodeId node : {firstNode(model, side), lastNode(model, side)})
      weakest_[node.value] = std::min(weakest_[node.value], strength);
    changed.push_back(one.edge);
  }
  sortUnique(changed);
  return changed;
}

}  // namespace yadefrag
