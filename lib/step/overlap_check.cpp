#include "step/overlap_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/tolerances/contact.hpp"
#include "search/contact_search.hpp"
#include "step/world.hpp"

namespace yadefrag {
namespace {

using Corners = std::array<Vec2, 3>;

/// A boundary segment, or a triangle, of any body. `held`: all its nodes are held in both
/// directions. `isLine`: of a rigid boundary whose material may be on either side.
struct BoundarySide {
  Vec2 from, to;
  bool held;
  ComponentId body;
  bool isLine;
};
struct Facet {
  Corners corners;
  bool held;
  ComponentId body;
};

template <class Points>
Box boxAround(const Points& points) {
  Box box = Box::absent();
  for (const Vec2 point : points) include(box, point);
  return box;
}
Box boxOf(const BoundarySide& side) { return boxAround(std::array{side.from, side.to}); }
Box boxOf(const Facet& facet) { return boxAround(facet.corners); }

/// The part of a segment, from 0 to 1, that is deeper than `margin` (m) in a triangle.
struct Part {
  double begin = 0, end = 1;
  [[nodiscard]] bool isEmpty() const { return !(begin < end); }
};

Part partInside(Vec2 from, Vec2 to, const Corners& triangle, double margin) {
  Part part;
  for (int i = 0; i < 3; ++i) {
    const Vec2 corner = triangle[i];
    const Vec2 along = triangle[(i + 1) % 3] - corner;
    const double length = norm(along);
    const double first = cross(along, from - corner) - margin * length;
    const double last = cross(along, to - corner) - margin * length;
    if (first <= 0 && last <= 0) return {1, 0};
    const double at = first / (first - last);
    if (first < 0) part.begin = std::max(part.begin, at);
    if (last < 0) part.end = std::min(part.end, at);
  }
  return part;
}

/// (m) Depth up to which contact counts as touching, for the shortest possible piece on these
/// edges.
double margin(const Corners& triangle, Vec2 from, Vec2 to) {
  double shortest = norm(to - from), farthest = 0;
  for (int i = 0; i < 3; ++i) {
    shortest = std::min(shortest, norm(triangle[(i + 1) % 3] - triangle[i]));
    farthest = std::max({farthest, std::abs(triangle[i].x), std::abs(triangle[i].y)});
  }
  return std::max(.5 * tolerance::kTouching * shortest, tolerance::kTouchRounding * farthest);
}

/// Points inside both, at least one if they overlap: the ends and the middle of the side's part in
/// the triangle.
std::vector<Vec2> meet(const BoundarySide& side, const Facet& facet) {
  if (side.held && facet.held) return {};
  const Vec2 along = side.to - side.from;
  const double touching = margin(facet.corners, side.from, side.to);
  const Part part = partInside(side.from, side.to, facet.corners, touching);
  if (!part.isEmpty())
    return {side.from + (part.begin + part.end) / 2 * along, side.from + part.begin * along,
            side.from + part.end * along};
  // If two bodies have the same outline, no side is inside the other one; the material beside it
  // is.
  const Vec2 beside = .5 * (side.from + side.to) - (touching / norm(along)) * rightOf(along);
  if (partInside(beside, beside, facet.corners, .5 * touching).isEmpty()) return {};
  return {beside, (1. / 3) * (facet.corners[0] + facet.corners[1] + facet.corners[2])};
}

/// A triangle beside the left side of a line.
struct Along {
  BoundarySide side;
  Part part;
  ComponentId body;
};

/// A point of the line inside the triangle; or, since a line may touch triangles with either side,
/// one at which triangles of one body lie on both sides. `known`: all triangles so far.
std::vector<Vec2> meetLine(const BoundarySide& side, const Facet& facet,
                           std::vector<Along>& known) {
  if (side.held && facet.held) return {};
  const Vec2 along = side.to - side.from;
  const double touching = margin(facet.corners, side.from, side.to);
  Part part = partInside(side.from, side.to, facet.corners, touching);
  if (!part.isEmpty()) return {side.from + (part.begin + part.end) / 2 * along};
  const Vec2 left = -(2 * touching / norm(along)) * rightOf(along);
  part = partInside(side.from + left, side.to + left, facet.corners, .5 * touching);
  if (part.isEmpty()) return {};
  known.push_back({side, part, facet.body});
  for (const Along& other : known) {
    if (other.body != facet.body || other.side.from != side.to || other.side.to != side.from)
      continue;
    const Part both{std::max(part.begin, 1 - other.part.end),
                    std::min(part.end, 1 - other.part.begin)};
    if (both.end - both.begin > tolerance::kTouching) return {side.from + both.begin * along};
  }
  return {};
}

/// Sides and triangles of the bodies that may overlap, within a common box.
class OverlapSearch {
 public:
  /// Keeps sides outside the box, too: of a body around it, their distance is the depth.
  void add(const BoundarySide& side) { sides_.push_back(side); }
  void add(const Facet& facet) {
    if (overlaps(boxOf(facet), within_)) facets_.push_back(facet);
  }
  /// Limits the triangles to this box.
  void limitTo(const Box& box) { within_ = box; }

  [[nodiscard]] std::optional<Overlap> find(ComponentId newBody) const {
    std::vector<Along> known;
    std::optional<Overlap> deepest;
    double enough = INFINITY;  // a deeper overlap is no matter of rounded coordinates
    for (const Near& near : pairs(newBody)) {
      const BoundarySide& side = sides_[near.side];
      const Facet& facet = facets_[near.facet];
      for (const Vec2 place : side.isLine ? meetLine(side, facet, known) : meet(side, facet)) {
        const double depth = distanceTo(facet.body, place);
        enough = std::min(enough, norm(side.to - side.from));
        if (!deepest || depth > deepest->depth)
          deepest = Overlap{std::min(side.body, facet.body), place, depth};
      }
      if (deepest && deepest->depth > enough) break;
    }
    return deepest;
  }

 private:
  struct Near {
    std::uint32_t side, facet;
    friend auto operator<=>(const Near&, const Near&) = default;
  };
  /// The sides near the triangles, one of the two of the new body; ascending. Only the sides are
  /// searched: most of the triangles of a body are near each other.
  [[nodiscard]] std::vector<Near> pairs(ComponentId newBody) const {
    std::vector<Box> boxes;
    boxes.reserve(sides_.size());
    for (const BoundarySide& side : sides_) boxes.push_back(boxOf(side));
    const auto search = makeSearch(SearchMethod::kLebesgue);
    search->update(boxes);
    std::vector<Near> pairs;
    std::vector<BoxId> found;
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      found.clear();
      search->findOverlaps(boxOf(facets_[f]), found);
      for (const BoxId side : found)
        if ((sides_[side.value].body == newBody) != (facets_[f].body == newBody))
          pairs.push_back({side.value, f});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// (m) Distance of a point from the sides of a body.
  [[nodiscard]] double distanceTo(ComponentId body, Vec2 point) const {
    double least = INFINITY;
    for (const BoundarySide& side : sides_) {
      if (side.body != body) continue;
      const Vec2 along = side.to - side.from;
      const double share = std::clamp(dot(point - side.from, along) / dot(along, along), 0., 1.);
      least = std::min(least, norm(side.from + share * along - point));
    }
    return least;
  }

  std::vector<BoundarySide> sides_;
  std::vector<Facet> facets_;
  Box within_ = Box::absent();
};

/// Adds the sides of an existing body, and its triangles that are near.
void addBody(OverlapSearch& search, const Model& model, const ContactSurfaces& surfaces,
             const std::vector<SegmentId>& segments, ComponentId body) {
  const Nodes& nodes = model.nodes;
  const auto at = [&](NodeId node) { return nodes.position[node.value]; };
  const auto isHeld = [&](NodeId node) { return nodes.held[node.value] == kHeldXY; };
  for (const SegmentId segment : segments) {
    const NodeId a = surfaces.segmentNode[segment.value];
    const NodeId b = surfaces.segmentNode[surfaces.segmentNext[segment.value].value];
    search.add(BoundarySide{at(a), at(b), isHeld(a) && isHeld(b), body,
                            model.components[body.value].rigid});
  }
  const Component& component = model.components[body.value];
  for (std::uint32_t e = component.firstTriangle; e < component.lastTriangle; ++e) {
    if (model.triangles.isDropped(e)) continue;
    const auto& [a, b, c] = model.triangles.nodes[e];
    search.add(Facet{{at(a), at(b), at(c)}, isHeld(a) && isHeld(b) && isHeld(c), body});
  }
}

void addNew(OverlapSearch& search, const TriangleMesh& mesh, const std::vector<Vec2>& positions,
            const std::vector<std::uint8_t>& held, ComponentId body, bool isLine) {
  const auto isHeld = [&](std::uint32_t node) { return !held.empty() && held[node] == kHeldXY; };
  for (const auto& loop : mesh.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      search.add(BoundarySide{positions[a], positions[b], isHeld(a) && isHeld(b), body, isLine});
    }
  for (const auto& [a, b, c] : mesh.triangles)
    search.add(Facet{
        {positions[a], positions[b], positions[c]}, isHeld(a) && isHeld(b) && isHeld(c), body});
}

Corners cornersOf(const Model& model, std::size_t triangle) {
  const auto& [a, b, c] = model.triangles.nodes[triangle];
  const std::vector<Vec2>& at = model.nodes.position;
  return {at[a.value], at[b.value], at[c.value]};
}

bool shareNode(const std::array<NodeId, 3>& a, const std::array<NodeId, 3>& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

}  // namespace

std::optional<Overlap> findOverlap(const Model& model, const ContactSurfaces& surfaces,
                                   const BodyPlaces& places, const TriangleMesh& mesh,
                                   const BodySpec& spec) {
  std::vector<Vec2> positions = mesh.nodes;
  for (std::size_t i = 0; i < spec.displacement.size(); ++i) positions[i] += spec.displacement[i];
  const Box own = boxAround(positions);
  const ComponentId newBody(model.components.size());
  OverlapSearch search;
  search.limitTo(own);
  Box near = Box::absent();
  for (std::size_t c = 0; c < model.components.size(); ++c) {
    const ComponentId body(c);
    const Box& box = places.box(body);
    if (!overlaps(box, own)) continue;
    addBody(search, model, surfaces, places.segments(body), body);
    include(near, {box.min[0], box.min[1]});
    include(near, {box.max[0], box.max[1]});
  }
  if (near.isAbsent()) return std::nullopt;
  search.limitTo(near);
  addNew(search, mesh, positions, spec.held, newBody, spec.rigid && mesh.triangles.empty());
  return search.find(newBody);
}

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

double overlapOf(const Corners& a, const Corners& b) {
  double least = INFINITY;
  for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 from = (*own)[k], along = (*own)[(k + 1) % 3] - from;
      double inside = 0;
      for (const Vec2 point : *other) inside = std::max(inside, cross(along, point - from));
      least = std::min(least, inside / norm(along));
    }
  return least;
}

double deepestOverlap(const Model& model, int threads) {
  return deepestOverlap(model, std::vector<std::uint8_t>(model.nodes.size(), 1), threads);
}

double deepestOverlap(const Model& model, std::span<const std::uint8_t> among, int threads) {
  const Triangles& triangles = model.triangles;
  const auto isAmong = [&](std::size_t t) {
    return !triangles.isDropped(t) && std::ranges::any_of(triangles.nodes[t], [&](NodeId node) {
      return among[node.value] != 0;
    });
  };
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    boxes.push_back(isAmong(t) ? boxAround(cornersOf(model, t)) : Box::absent());
  double deepest = 0;
  for (const auto& [first, second] : overlappingPairs(boxes, threads, SearchMethod::kFastest))
    if (!shareNode(triangles.nodes[first.value], triangles.nodes[second.value]))
      deepest = std::max(deepest,
                         overlapOf(cornersOf(model, first.value), cornersOf(model, second.value)));
  return deepest;
}

}  // namespace yadefrag
