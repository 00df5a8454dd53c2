#include "fracture/loose_fragments.hpp"

#include <algorithm>

namespace yadefrag {

void LooseFragments::find(const Model& model, const CrackEdges& edges, const Cohesion& cohesion,
                          std::span<const ElementId> around, double area) {
  triangles.clear();
  count = 0;
  met_.resize(model.triangles.size());
  holds_.resize(edges.size());
  for (const EdgeId edge : cohesion.edge) holds_[edge.value] = 1;
  firstWalk_ = walk_ + 1;
  for (const ElementId start : around) {
    if (met_[start.value] >= firstWalk_ || model.triangles.isDropped(start.value)) continue;
    if (!model.bodyOf(start).brittle.cracks()) continue;  // only bonded, not brittle
    if (!grow(model, edges, start, area)) continue;
    // In one order for any start of the walk: the last bit of the area may be decisive.
    std::sort(fragment_.begin(), fragment_.end());
    if (!isLoose(model, edges, area)) continue;
    triangles.insert(triangles.end(), fragment_.begin(), fragment_.end());
    ++count;
  }
  for (const EdgeId edge : cohesion.edge) holds_[edge.value] = 0;
}

/// Walks over the triangles connected with `start`. Returns false if the fragment is too large, or
/// if an earlier walk met it, which would have visited a small fragment completely.
bool LooseFragments::grow(const Model& model, const CrackEdges& edges, ElementId start,
                          double area) {
  ++walk_;
  fragment_.assign(1, start);
  met_[start.value] = walk_;
  double sum = 0;
  for (std::size_t i = 0; i < fragment_.size(); ++i) {
    sum += model.triangles.area[fragment_[i].value];
    if (sum >= 2 * area) return false;
    for (std::uint8_t corner = 0; corner < 3; ++corner) {
      const ElementId next = edges.across({fragment_[i], corner});
      if (next == ElementId::none() || met_[next.value] == walk_) continue;
      if (met_[next.value] >= firstWalk_) return false;
      met_[next.value] = walk_;
      fragment_.push_back(next);
    }
  }
  return true;
}

bool LooseFragments::isLoose(const Model& model, const CrackEdges& edges, double area) const {
  const ComponentId component = model.triangles.component[fragment_.front().value];
  const Component& body = model.components[component.value];
  if (fragment_.size() == body.lastTriangle - body.firstTriangle) return false;
  double sum = 0;
  for (const ElementId element : fragment_) {
    sum += model.triangles.area[element.value];
    for (const NodeId node : model.triangles.nodes[element.value])
      if (model.nodes.held[node.value] != kFree) return false;
    for (std::uint8_t corner = 0; corner < 3; ++corner)
      if (isHeldAt(edges, {element, corner})) return false;
  }
  return sum < area;
}

bool LooseFragments::isHeldAt(const CrackEdges& edges, Side side) const {
  const EdgeId edge = edges.ofElement[side.element.value][side.corner];
  return edge != EdgeId::none() && holds_[edge.value] != 0 &&
         met_[edges.twin(side).element.value] != walk_;
}

}  // namespace yadefrag
