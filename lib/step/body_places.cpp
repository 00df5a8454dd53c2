#include "step/body_places.hpp"

#include <algorithm>

namespace yadefrag {

void include(Box& box, Vec2 point) {
  const double at[] = {point.x, point.y, 0};
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], at[axis]);
    box.max[axis] = std::max(box.max[axis], at[axis]);
  }
}

void BodyPlaces::update(const Model& model, const ContactSurfaces& surfaces) {
  boxes_.resize(model.components.size(), Box::absent());
  segments_.resize(model.components.size());
  for (; knownNodes_ < model.nodes.size(); ++knownNodes_)
    include(boxes_[model.nodes.component[knownNodes_].value], model.nodes.position[knownNodes_]);
  for (; knownSegments_ < surfaces.segments(); ++knownSegments_) {
    const SegmentId segment(knownSegments_);
    if (surfaces.isGone(segment)) continue;
    const NodeId node = surfaces.segmentNode[segment.value];
    segments_[model.nodes.component[node.value].value].push_back(segment);
  }
}

}  // namespace yadefrag
