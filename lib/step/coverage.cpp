#include "step/coverage.hpp"

#include <algorithm>

#include "step/world.hpp"

namespace yadefrag {

std::vector<ComponentId> bodiesOf(const Model& model) {
  std::vector<ComponentId> bodies;
  for (std::size_t c = 0; c < model.components.size(); ++c)
    if (model.components[c].firstTriangle != model.components[c].lastTriangle)
      bodies.emplace_back(c);
  return bodies;
}

Snapped snapOnBodies(const World& world, const Polygon& polygon, const SnapRule& rule) {
  Box own = Box::absent();
  for (const Vec2 point : polygon.outline) include(own, point);
  for (int axis = 0; axis < 2; ++axis)
    own.min[axis] -= rule.tolerance, own.max[axis] += rule.tolerance;
  const ContactSurfaces& surfaces = world.surfaces;
  const auto at = [&](SegmentId segment) {
    return world.model.nodes.position[surfaces.segmentNode[segment.value].value];
  };
  SnapSides sides;
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    const SegmentId segment(s);
    if (surfaces.isGone(segment)) continue;
    const std::array ends{at(segment), at(surfaces.segmentNext[s])};
    Box box = Box::absent();
    for (const Vec2 end : ends) include(box, end);
    if (overlaps(box, own)) sides.push_back(ends);
  }
  return snapOnto(polygon, sides, rule);
}

}  // namespace yadefrag
