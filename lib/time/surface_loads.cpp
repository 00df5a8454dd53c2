#include "time/surface_loads.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace yadefrag {
namespace {

struct Ends {
  NodeId first, last;
  Ends(const ContactSurfaces& surfaces, SegmentId segment)
      : first(surfaces.segmentNode[segment.value]),
        last(surfaces.segmentNode[surfaces.segmentNext[segment.value].value]) {}
};

const Component& bodyOf(const Model& model, const ContactSurfaces& surfaces, SegmentId segment) {
  return model.components[surfaces.component[surfaces.segmentEntry[segment.value].value].value];
}

/// (m) Depth of the part of a side that is an end's: with an axis, of a uniform load on a cone, two
/// thirds of the end's circle and one third of the other's.
double depthAt(const Model& model, const Component& body, const Ends& ends, NodeId node) {
  const NodeId other = node == ends.first ? ends.last : ends.first;
  const Vec2 here = model.nodes.position[node.value], there = model.nodes.position[other.value];
  return model.depthOf(body, here, (1. / 3) * here + (2. / 3) * there);
}

}  // namespace

void addPressure(const Model& model, const ContactSurfaces& surfaces,
                 std::span<const SegmentId> segments, double pressure, std::vector<Vec2>& forces) {
  for (const SegmentId segment : segments) {
    if (surfaces.isGone(segment)) continue;
    const Ends ends(surfaces, segment);
    const Vec2 along =
        model.nodes.position[ends.last.value] - model.nodes.position[ends.first.value];
    const Component& body = bodyOf(model, surfaces, segment);
    for (const NodeId node : {ends.first, ends.last})
      forces[node.value] += (-.5 * pressure * depthAt(model, body, ends, node)) * rightOf(along);
  }
}

void spread(Pressure& pressure, const ContactSurfaces& surfaces) {
  std::vector<bool> has(surfaces.segments());
  for (const SegmentId s : pressure.segments) has[s.value] = true;
  // Segments added here are visited by this loop, too.
  for (std::size_t i = 0; i < pressure.segments.size(); ++i)
    for (const auto* links : {&surfaces.segmentNext, &surfaces.segmentPrev}) {
      const SegmentId other = (*links)[pressure.segments[i].value];
      if (other.value < pressure.firstNew || has[other.value] || surfaces.isGone(other)) continue;
      has[other.value] = true;
      pressure.segments.push_back(other);
    }
}

/// A segment's triangle stays the same when nodes split.
void AbsorbingBoundary::findTriangles(const Model& model, const ContactSurfaces& surfaces) {
  behind_.clear();
  const auto isMixed = [&](SegmentId s) { return bodyOf(model, surfaces, s).isMixed(); };
  if (std::ranges::none_of(segments, isMixed)) return;
  std::vector<ElementId> of(surfaces.segments(), ElementId::none());
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& nodes = model.triangles.nodes[e];
      if (nodes[i].value >= surfaces.nodeSegment.size()) continue;
      const SegmentId segment = surfaces.nodeSegment[nodes[i].value];
      if (segment != SegmentId::none() && Ends(surfaces, segment).last == nodes[(i + 1) % 3])
        of[segment.value] = ElementId(e);
    }
  for (const SegmentId s : segments) behind_.push_back(of[s.value]);
}

void AbsorbingBoundary::collect(const Model& model, const ContactSurfaces& surfaces,
                                std::span<const Vec2> place) {
  assert(behind_.empty() || behind_.size() == segments.size());
  dashpots_.clear();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const SegmentId segment = segments[i];
    if (surfaces.isGone(segment)) continue;
    const Ends ends(surfaces, segment);
    const Vec2 along = place[ends.last.value] - place[ends.first.value];
    const double length = norm(along);
    if (!(length > 0)) continue;
    const Component& body = bodyOf(model, surfaces, segment);
    const ElasticMaterial& m =
        behind_.empty() ? body.material : model.materialOf(behind_[i]).material;
    const Vec2 t = (1 / length) * along, n = rightOf(t);
    for (const NodeId node : {ends.first, ends.last}) {
      const double half = .5 * length * depthAt(model, body, ends, node);
      const double normal = half * std::sqrt(m.density * m.waveModulus());
      const double shear = half * std::sqrt(m.density * m.shearModulus());
      dashpots_.push_back({node, normal * n.x * n.x + shear * t.x * t.x,
                           normal * n.x * n.y + shear * t.x * t.y,
                           normal * n.y * n.y + shear * t.y * t.y});
    }
  }
  // Both segments at a node act as one.
  std::ranges::stable_sort(dashpots_, {}, [](const Dashpot& d) { return d.node.value; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < dashpots_.size(); ++i) {
    Dashpot& one = dashpots_[i];
    if (i > 0 && dashpots_[kept - 1].node == one.node) {
      Dashpot& sum = dashpots_[kept - 1];
      sum.xx += one.xx, sum.xy += one.xy, sum.yy += one.yy;
    } else {
      dashpots_[kept++] = one;
    }
  }
  dashpots_.resize(kept);
}

/// m'(v − v*) = −ΔvC(v + v⁻)/2 with m' = m(1 + drag), in the directions that are not held.
void AbsorbingBoundary::correct(Model& model, const ContactSurfaces& surfaces,
                                std::span<const Vec2> place, std::span<const Vec2> before,
                                const StepLength& step, double drag) {
  collect(model, surfaces, place);
  Nodes& nodes = model.nodes;
  const double half = step.velocity / 2;
  for (Dashpot& d : dashpots_) {
    const std::uint32_t n = d.node.value;
    const double mass = nodes.mass[n] * (1 + drag);
    Vec2& v = nodes.velocity[n];
    const Vec2 sum = v + before[n];
    const Vec2 pull{half * (d.xx * sum.x + d.xy * sum.y), half * (d.xy * sum.x + d.yy * sum.y)};
    const double xx = mass + half * d.xx, yy = mass + half * d.yy, xy = half * d.xy;
    Vec2 change;
    switch (nodes.held[n]) {
      case kFree: {
        const double det = xx * yy - xy * xy;
        change = {-(yy * pull.x - xy * pull.y) / det, -(xx * pull.y - xy * pull.x) / det};
        break;
      }
      case kHeldX:
        change.y = -pull.y / yy;
        break;
      case kHeldY:
        change.x = -pull.x / xx;
        break;
      default:
        break;
    }
    v += change;
    nodes.position[n] += step.position * change;
    d.force = (mass / step.velocity) * change;
  }
}

void AbsorbingBoundary::addWork(EnergyLedger& ledger, const Model& model,
                                std::span<const Vec2> before, const StepLength& step) const {
  for (const Dashpot& d : dashpots_) {
    const Vec2 mean = .5 * (before[d.node.value] + model.nodes.velocity[d.node.value]);
    ledger.damping -= step.velocity * dot(d.force, mean);
  }
}

}  // namespace yadefrag
