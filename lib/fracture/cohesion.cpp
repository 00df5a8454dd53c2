#include "fracture/cohesion.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"
#include "fracture/cohesive_law.hpp"
#include "mesh/mobility.hpp"

namespace yadefrag {
namespace {

/// The nodes at one end of an edge: those of its first and second triangle.
std::array<NodeId, 2> nodesAt(const Model& model, const CrackEdges& edges, EdgeId edge, int end) {
  const Side first = edges.side(edge, 0), second = edges.side(edge, 1);
  if (end == 0) return {firstNode(model, first), lastNode(model, second)};
  return {lastNode(model, first), firstNode(model, second)};
}

const BrittleMaterial& materialOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const ElementId element = edges.side(edge, 0).element;
  return model.components[model.triangles.component[element.value].value].brittle;
}

/// (m) δc = 2Gc/σc.
double criticalOpening(const CrackEdges& edges, EdgeId edge) {
  return 2 * edges.fractureEnergy[edge.value] / edges.strength[edge.value];
}

}  // namespace

void Cohesion::add(const Model& model, const CrackEdges& edges, EdgeId cracked,
                   std::span<const Vec2> reference) {
  const Side side = edges.side(cracked, 0);
  const Vec2 along =
      reference[lastNode(model, side).value] - reference[firstNode(model, side).value];
  const ComponentId body = model.triangles.component[side.element.value];
  edge.push_back(cracked);
  largest.push_back({0, 0});
  area.push_back(norm(along) / 2 * model.components[body.value].thickness);
}

template <class Keep>
void Cohesion::keepOnly(Keep keep) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < edge.size(); ++c)
    if (keep(c)) edge[kept] = edge[c], largest[kept] = largest[c], area[kept++] = area[c];
  edge.resize(kept), largest.resize(kept), area.resize(kept);
}

void Cohesion::renumberEdges(std::span<const EdgeId> renumbered) {
  keepOnly([&](std::size_t c) { return renumbered[edge[c].value] != EdgeId::none(); });
  for (EdgeId& one : edge) one = renumbered[one.value];
}

void Cohesion::collect(const Model& model, const CrackEdges& edges, std::span<const Vec2> before,
                       const StepLength& step, double drag) {
  points_.clear();
  turned_.clear();
  for (std::uint32_t c = 0; c < edge.size(); ++c) {
    const auto [a, b] = nodesAt(model, edges, edge[c], 0);
    const auto [d, e] = nodesAt(model, edges, edge[c], 1);
    if (a == b && d == e) continue;
    const double critical = criticalOpening(edges, edge[c]);
    const Vec2 first = before[d.value] - before[a.value];
    const Vec2 second = before[e.value] - before[b.value];
    // Faces at a right angle hang together by an end at most, and soon have no common normal.
    if (dot(first, second) <= 0) {
      turned_.push_back(c);
      continue;
    }
    const Vec2 across = rightOf(first + second);
    for (std::uint32_t end = 0; end < 2; ++end) {
      const NodeId here = end == 0 ? a : d, there = end == 0 ? b : e;
      // What is broken touches like any other surface, whatever way it has turned since.
      if (here == there || largest[c][end] >= critical) continue;
      const Vec2 mobile = step.squared() * area[c] *
                          (mobility(model.nodes, here, drag) + mobility(model.nodes, there, drag));
      points_.push_back({here,
                         there,
                         (1 / norm(across)) * across,
                         mobile,
                         area[c],
                         edges.strength[edge[c].value],
                         critical,
                         materialOf(model, edges, edge[c]).shearFactor,
                         largest[c][end],
                         {},
                         c,
                         end});
    }
  }
}

/// The effective opening √(δₙ² + β²δₛ²) of faces that are `apart` (m); its direction is that of the
/// traction.
double Cohesion::openingOf(const Point& point, Vec2 apart, Vec2& direction) {
  const Vec2 tangent = -rightOf(point.normal);
  const double beta = point.shearFactor;
  const double normal = std::max(0., dot(apart, point.normal));
  const double shear = dot(apart, tangent);
  const double effective = std::hypot(normal, beta * shear);
  direction = {};
  if (effective > 0)
    direction = (normal / effective) * point.normal + (beta * beta * shear / effective) * tangent;
  return effective;
}

/// (m/Pa) What a traction in this direction takes from the opening along it.
double Cohesion::complianceAlong(const Point& point, Vec2 direction) {
  return point.compliance.x * direction.x * direction.x +
         point.compliance.y * direction.y * direction.y;
}

/// What the law does to faces that would end up `opening` apart without it.
Vec2 Cohesion::held(const Point& point, Vec2 opening) {
  Vec2 direction;
  const double trial = openingOf(point, opening, direction);
  return cohesiveTraction(point.strength, point.critical, point.largest, trial,
                          complianceAlong(point, direction)) *
         direction;
}

/// What keeps the faces from closing further than shut.
Vec2 Cohesion::shut(const Point& point, Vec2 opening) {
  const double gap = dot(opening, point.normal);
  const double compliance = complianceAlong(point, point.normal);
  if (gap >= 0 || compliance <= 0) return {};
  return (gap / compliance) * point.normal;
}

/// Sets one point's traction right, the others being what they are; returns its change (Pa).
double Cohesion::relax(Model& model, Point& point) const {
  std::vector<Vec2>& position = model.nodes.position;
  const Vec2 own{point.compliance.x * point.traction.x, point.compliance.y * point.traction.y};
  const Vec2 opening = position[point.there.value] - position[point.here.value] + own;
  const Vec2 traction = held(point, opening) + shut(point, opening);
  const Vec2 change = traction - point.traction;
  point.traction = traction;
  const double rate = squaredStep_ * point.area;
  const Vec2 here = mobility(model.nodes, point.here, drag_);
  const Vec2 there = mobility(model.nodes, point.there, drag_);
  position[point.here.value] += rate * Vec2{here.x * change.x, here.y * change.y};
  position[point.there.value] -= rate * Vec2{there.x * change.x, there.y * change.y};
  return norm(change);
}

double Cohesion::correct(Model& model, const CrackEdges& edges, std::span<const Vec2> before,
                         const StepLength& step, double drag) {
  if (edge.empty()) return 0;
  squaredStep_ = step.squared(), drag_ = drag;
  collect(model, edges, before, step, drag);
  for (int sweep = 0; sweep < tolerance::kCohesionSweeps; ++sweep) {
    double worst = 0;
    for (Point& point : points_) worst = std::max(worst, relax(model, point) / point.strength);
    if (worst <= tolerance::kCohesionChange) break;
  }
  double most = 0;
  for (const Point& point : points_) {
    for (const double sign : {1., -1.}) {
      const NodeId node = sign > 0 ? point.here : point.there;
      const Vec2 mobile = mobility(model.nodes, node, drag);
      const Vec2 u = sign * step.squared() * point.area *
                     Vec2{mobile.x * point.traction.x, mobile.y * point.traction.y};
      model.nodes.velocity[node.value] += (1 / step.position) * u;
      most = std::max(most, norm(u));
    }
  }
  return most;
}

void Cohesion::addForces(std::vector<Vec2>& forces) const {
  for (const Point& point : points_) {
    forces[point.here.value] += point.area * point.traction;
    forces[point.there.value] -= point.area * point.traction;
  }
}

double Cohesion::work(const Model& model, std::span<const Vec2> previousVelocity,
                      const StepLength& step) const {
  double work = 0;
  for (const Point& point : points_) {
    const auto mean = [&](NodeId node) {
      return .5 * (previousVelocity[node.value] + model.nodes.velocity[node.value]);
    };
    work += step.velocity * point.area * dot(point.traction, mean(point.there) - mean(point.here));
  }
  return work;
}

void Cohesion::settle(const Model& model, const CrackEdges& edges) {
  const std::vector<Vec2>& position = model.nodes.position;
  for (const Point& point : points_) {
    Vec2 direction;
    double& widest = largest[point.crack][point.end];
    const Vec2 apart = position[point.there.value] - position[point.here.value];
    widest = std::max(widest, openingOf(point, apart, direction));
  }
  points_.clear();
  const auto critical = [&](std::size_t c) { return criticalOpening(edges, edge[c]); };
  for (const std::uint32_t c : turned_) largest[c] = {critical(c), critical(c)};
  turned_.clear();  // without a crack left, the next step collects nothing
  released.clear();
  keepOnly([&](std::size_t c) {
    const bool holds = largest[c][0] < critical(c) || largest[c][1] < critical(c);
    if (!holds) released.push_back(edge[c]);
    return holds;
  });
}

void Cohesion::removeDropped(const Triangles& triangles, const CrackEdges& edges) {
  keepOnly(
      [&](std::size_t c) { return !triangles.isDropped(edges.side(edge[c], 0).element.value); });
}

}  // namespace yadefrag
