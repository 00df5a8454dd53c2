#include "fracture/strength_check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "dynamics/element_state.hpp"
#include "fracture/separation.hpp"

namespace yadefrag {
namespace {

/// (rad) A node whose triangles fill more than this is a notch's or a crack's tip.
constexpr double kTipAngle = 1.1 * std::numbers::pi;

/// The corners after and before the one at `node`, counter-clockwise.
std::array<Vec2, 2> oppositeEnds(const Model& model, ElementId element, NodeId node) {
  const int corner = cornerOf(model, element, node);
  const auto& nodes = model.triangles.nodes[element.value];
  return {model.nodes.position[nodes[afterCorner(corner)].value],
          model.nodes.position[nodes[beforeCorner(corner)].value]};
}

double angleOf(const Model& model, std::span<const ElementId> fan, NodeId node) {
  const Vec2 at = model.nodes.position[node.value];
  double angle = 0;
  for (const ElementId element : fan) {
    const auto [a, b] = oppositeEnds(model, element, node);
    angle += std::atan2(cross(a - at, b - at), dot(a - at, b - at));
  }
  return angle;
}

double lengthOf(const Model& model, Side side) {
  return norm(model.nodes.position[lastNode(model, side).value] -
              model.nodes.position[firstNode(model, side).value]);
}

/// (m) Of the crack that ends at `tip`, whose fan begins and ends at its faces; 0: it is a notch.
double crackAt(const Model& model, const CrackEdges& edges, std::span<const ElementId> fan,
               NodeId tip) {
  const Side first{fan.front(), static_cast<std::uint8_t>(cornerOf(model, fan.front(), tip))};
  const Side last{fan.back(), beforeCorner(cornerOf(model, fan.back(), tip))};
  const EdgeId edge = edges.ofElement[first.element.value][first.corner];
  const bool isCrack =
      edge != EdgeId::none() && edge == edges.ofElement[last.element.value][last.corner];
  return isCrack ? lengthOf(model, first) : 0;
}

}  // namespace

std::vector<EdgeId> StrengthCheck::overstressed(const Model& model, const CrackEdges& edges,
                                                std::span<const ElementRange> where,
                                                std::span<const double> leastStrength) {
  prepare(model, edges);
  ++call_;
  found_.clear();
  // The stress of a node that is looked at belongs to all edges that end there, whosever they are.
  for (const ElementRange& range : where)
    for (std::uint32_t e = range.firstElement; e < range.lastElement; ++e)
      if (!model.triangles.isDropped(e)) lookAtCorners(model, edges, ElementId(e), leastStrength);
  return pickApart(model, edges);
}

/// Most of what is stressed in rubble has no edge left that could crack.
void StrengthCheck::lookAtCorners(const Model& model, const CrackEdges& edges, ElementId element,
                                  std::span<const double> leastStrength) {
  std::array<bool, 3> whole{};
  for (std::uint8_t i = 0; i < 3; ++i) whole[i] = edges.across({element, i}) != ElementId::none();
  for (std::uint8_t i = 0; i < 3; ++i)
    if (whole[i] || whole[beforeCorner(i)])
      lookAround(model, edges, model.triangles.nodes[element.value][i], leastStrength);
}

void StrengthCheck::lookAround(const Model& model, const CrackEdges& edges, NodeId node,
                               std::span<const double> leastStrength) {
  if (nodeLookedAt_[node.value] == call_) return;
  nodeLookedAt_[node.value] = call_;
  // Of an edge's two ends one at least bears as much by itself as their mean.
  const ComponentId body = model.nodes.component[node.value];
  const Component& component = model.components[body.value];
  const double most =
      largestTraction(stressAt(model, edges, node), component.brittle, component.friction);
  const bool isWeak = most >= leastStrength[body.value];
  if (!isWeak && component.brittle.fractureEnergy == 0) return;
  around_.clear();
  const bool isInside = edges.appendFan(model, node, around_);
  if (!isWeak && (isInside || angleOf(model, around_, node) <= kTipAngle)) return;
  for (const ElementId element : around_) {
    const int corner = cornerOf(model, element, node);
    for (const int side : {corner, static_cast<int>(beforeCorner(corner))}) {
      const EdgeId edge = edges.ofElement[element.value][static_cast<std::size_t>(side)];
      if (edge == EdgeId::none() || edges.cracked[edge.value] != 0) continue;
      if (edgeSeen_[edge.value] == call_) continue;
      edgeSeen_[edge.value] = call_;
      const double ratio = ratioOf(model, edges, edge);
      if (ratio >= 1) found_.push_back({ratio, edge});
    }
  }
}

void StrengthCheck::prepare(const Model& model, const CrackEdges& edges) {
  elementSeen_.resize(model.triangles.size());
  elementStress_.resize(model.triangles.size());
  const std::size_t room = model.nodes.position.capacity();
  for (auto* marks : {&nodeSeen_, &nodeTaken_, &nodeLookedAt_}) marks->reserve(room);
  nodeStress_.reserve(room);
  nodeSeen_.resize(model.nodes.size());
  nodeStress_.resize(model.nodes.size());
  nodeTaken_.resize(model.nodes.size());
  nodeLookedAt_.resize(model.nodes.size());
  edgeSeen_.resize(edges.size());
}

const StrengthCheck::Stress& StrengthCheck::stressOf(const Model& model, ElementId element) {
  Stress& stress = elementStress_[element.value];
  if (elementSeen_[element.value] == call_) return stress;
  elementSeen_[element.value] = call_;
  return stress = yadefrag::stressOf(model, element);
}

const StrengthCheck::Stress& StrengthCheck::stressAt(const Model& model, const CrackEdges& edges,
                                                     NodeId node) {
  Stress& mean = nodeStress_[node.value];
  if (nodeSeen_[node.value] == call_) return mean;
  nodeSeen_[node.value] = call_;
  fan_.clear();
  edges.appendFan(model, node, fan_);
  mean = {};
  double whole = 0;
  for (const ElementId element : fan_) {
    const double area = model.triangles.area[element.value];
    const Stress& stress = stressOf(model, element);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += area * stress[i];
    whole += area;
  }
  for (double& component : mean) component /= whole;
  return mean;
}

double StrengthCheck::ratioOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Side side = edges.side(edge, 0);
  const NodeId a = firstNode(model, side), b = lastNode(model, side);
  Stress mean = stressAt(model, edges, a);
  const Stress& other = stressAt(model, edges, b);
  for (std::size_t i = 0; i < 3; ++i) mean[i] = .5 * (mean[i] + other[i]);
  const Vec2 across = rightOf(model.nodes.position[b.value] - model.nodes.position[a.value]);
  const Traction traction = tractionOn(mean, (1 / norm(across)) * across);
  const Component& body = model.components[model.triangles.component[side.element.value].value];
  double most = effectiveTraction(traction.normal, traction.shear, body.brittle, body.friction);
  if (body.brittle.fractureEnergy > 0) {
    const Vec2 normal = (1 / norm(across)) * across;
    // The pull alone: with the shear, cracks in mode II run on ahead (Kalthoff: 30 to 42°).
    for (const NodeId end : {a, b}) {
      const Traction tip = tractionAtTip(model, edges, edge, end, normal);
      most = std::max(most, tip.normal);
    }
  }
  return most / edges.strength[edge.value];
}

/// (Pa) What the edge transmits at a tip, by the forces of the triangles on either side of it; none
/// elsewhere. They act on half of the edge, and on half of the crack that ends there, which will
/// hold, too. `normal`: out of the edge's first triangle.
Traction StrengthCheck::tractionAtTip(const Model& model, const CrackEdges& edges, EdgeId edge,
                                      NodeId tip, Vec2 normal) {
  if (model.nodes.held[tip.value] != kFree) return {};
  fan_.clear();
  if (edges.appendFan(model, tip, fan_) || angleOf(model, fan_, tip) <= kTipAngle) return {};
  const auto placeOf = [&](int which) {
    return std::find(fan_.begin(), fan_.end(), edges.side(edge, which).element) - fan_.begin();
  };
  const auto first = placeOf(0), second = placeOf(1);
  std::array<Vec2, 2> force{};  // N/m, on the node's parts at the first and second triangle
  std::array<double, 2> area{};
  for (std::ptrdiff_t i = 0; i < std::ssize(fan_); ++i) {
    const std::size_t part = (i <= std::min(first, second)) == (first < second) ? 0 : 1;
    const auto [a, b] = oppositeEnds(model, fan_[i], tip);
    const Vec2 out = rightOf(b - a);
    const Stress& stress = stressOf(model, fan_[i]);
    force[part] +=
        .5 * Vec2{stress[0] * out.x + stress[2] * out.y, stress[2] * out.x + stress[1] * out.y};
    area[part] += model.triangles.area[fan_[i].value];
  }
  // What is left of either's force once both move alike.
  const Vec2 pull = (1 / (area[0] + area[1])) * (area[1] * force[0] - area[0] * force[1]);
  const double length =
      (lengthOf(model, edges.side(edge, 0)) + crackAt(model, edges, fan_, tip)) / 2;
  const Vec2 traction = (-1 / length) * pull;
  return {dot(normal, traction), cross(normal, traction)};
}

std::vector<EdgeId> StrengthCheck::pickApart(const Model& model, const CrackEdges& edges) {
  std::sort(found_.begin(), found_.end(), [](const Overstressed& a, const Overstressed& b) {
    return a.ratio != b.ratio ? a.ratio > b.ratio : a.edge < b.edge;
  });
  std::vector<EdgeId> picked;
  for (const Overstressed& one : found_) {
    const Side side = edges.side(one.edge, 0);
    const Component& body = model.components[model.triangles.component[side.element.value].value];
    if (body.brittle.fractureEnergy == 0) {
      std::uint32_t& first = nodeTaken_[firstNode(model, side).value];
      std::uint32_t& last = nodeTaken_[lastNode(model, side).value];
      if (first == call_ || last == call_) continue;
      first = last = call_;
    }
    picked.push_back(one.edge);
  }
  std::sort(picked.begin(), picked.end());
  return picked;
}

}  // namespace yadefrag
