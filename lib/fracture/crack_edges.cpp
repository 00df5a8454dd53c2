#include "fracture/crack_edges.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "fracture/edge_strength.hpp"

namespace yadefrag {
namespace {

constexpr std::array<EdgeId, 3> kNoEdges{EdgeId::none(), EdgeId::none(), EdgeId::none()};

/// Pairs of sides between the same two nodes, in the order of the triangles.
std::vector<std::array<Side, 2>> innerEdges(const Model& model, const Component& body) {
  const std::vector<KeyedSide> sides = sidesByNodes(model, body);
  std::vector<std::array<Side, 2>> inner;
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].joins(sides[i - 1])) inner.push_back({sides[i - 1].side, sides[i].side});
  std::sort(inner.begin(), inner.end());
  return inner;
}

/// The joints by the model's nodes, the lower one first.
using Joints = std::map<std::array<NodeId, 2>, const JointEdge*>;

Joints byNodes(const std::vector<JointEdge>& joints, NodeId first) {
  Joints result;
  for (const JointEdge& joint : joints) {
    const auto [low, high] = std::minmax(joint.nodes[0], joint.nodes[1]);
    result[{NodeId(first.value + low), NodeId(first.value + high)}] = &joint;
  }
  return result;
}

/// The material at the edge between two triangles; a triangle that never cracks is ignored.
BrittleMaterial materialAt(const Model& model, const BrittlePlaces& places, ElementId a,
                           ElementId b) {
  BrittleMaterial material = weakerOf(model, a, b).brittle;
  material.tensileStrength = material.fractureEnergy = kUnbreakable;
  bool cracks = false;
  for (const ElementId e : {a, b}) {
    const BrittleMaterial& own = model.materialOf(e).brittle;
    if (!own.cracks()) continue;
    cracks = true;
    const std::size_t i = e.value - model.bodyOf(e).firstTriangle;
    const double strength = places.strength.empty() ? own.tensileStrength : places.strength[i];
    const double energy =
        places.fractureEnergy.empty() ? own.fractureEnergy : places.fractureEnergy[i];
    material.tensileStrength = std::min(material.tensileStrength, strength);
    material.fractureEnergy = std::min(material.fractureEnergy, energy);
  }
  return cracks ? material : BrittleMaterial{};
}

}  // namespace

std::vector<KeyedSide> sidesByNodes(const Model& model, const Component& body) {
  std::vector<KeyedSide> sides;
  sides.reserve(3 * std::size_t{body.lastTriangle - body.firstTriangle});
  for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e) {
    if (model.triangles.isDropped(e)) continue;
    for (std::uint8_t c = 0; c < 3; ++c) {
      const Side side{ElementId(e), c};
      const auto [low, high] = std::minmax({firstNode(model, side), lastNode(model, side)});
      sides.push_back({low, high, side});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

void CrackEdges::append(Side a, Side b, double ofStrength, double ofEnergy, bool isCracked) {
  ofElement[a.element.value][a.corner] = ofElement[b.element.value][b.corner] = EdgeId(size());
  element.push_back({a.element, b.element});
  corner.push_back({a.corner, b.corner});
  strength.push_back(ofStrength);
  fractureEnergy.push_back(ofEnergy);
  cracked.push_back(isCracked ? 1 : 0);
}

std::vector<EdgeId> CrackEdges::addBody(const Model& model, ComponentId component,
                                        const BrittlePlaces& places) {
  const Component& body = model.components[component.value];
  ofElement.resize(model.triangles.size(), kNoEdges);
  ofNode.resize(model.nodes.size(), ElementId::none());
  NodeId firstOfBody = NodeId::none();
  for (std::uint32_t e = body.firstTriangle; e < body.lastTriangle; ++e)
    for (const NodeId node : model.triangles.nodes[e]) {
      ofNode[node.value] = ElementId(e);
      firstOfBody = std::min(firstOfBody, node);
    }
  const Joints joints = byNodes(places.joints, firstOfBody);
  std::vector<EdgeId> open;
  // Two bodies of the same material get different random numbers.
  std::uint64_t number = std::uint64_t{component.value} << 32;
  for (const auto& [a, b] : innerEdges(model, body)) {
    // A third of each triangle belongs to each of its sides.
    const double area =
        model.triangles.area[a.element.value] + model.triangles.area[b.element.value];
    const double depth = (model.depthOf(a.element) + model.depthOf(b.element)) / 2;
    const BrittleMaterial material = materialAt(model, places, a.element, b.element);
    append(a, b,
           material.cracks() ? edgeStrength(material, number, depth * area / 3) : kUnbreakable,
           material.fractureEnergy, false);
    ++number;
    const auto [low, high] = std::minmax({firstNode(model, a), lastNode(model, a)});
    const auto joint = joints.find({low, high});
    if (joint == joints.end()) continue;
    const JointEdge& own = *joint->second;
    if (own.strength != 0) {
      if (!std::isnan(own.strength)) strength.back() = own.strength;
      if (!std::isnan(own.fractureEnergy) && strength.back() != kUnbreakable)
        fractureEnergy.back() = own.fractureEnergy;
    } else {
      fractureEnergy.back() = 0;
      open.emplace_back(size() - 1);
    }
  }
  return open;
}

void CrackEdges::addBonds(const Model& model, std::span<const std::array<Side, 2>> sides,
                          double ofStrength, double ofEnergy) {
  ofElement.resize(model.triangles.size(), kNoEdges);
  ofNode.resize(model.nodes.size(), ElementId::none());
  for (const auto& both : sides) {
    const auto& [a, b] = std::minmax(both[0], both[1]);
    append(a, b, ofStrength, ofEnergy, true);
  }
}

std::vector<EdgeId> CrackEdges::removeBody(const Model& model, ElementId first, ElementId last,
                                           std::span<const NodeId> renumberedNodes) {
  assert(renumberedNodes.size() >= ofNode.size());
  assert(first <= last && model.triangles.size() + (last.value - first.value) >= ofElement.size());
  const std::uint32_t gone = last.value - first.value;
  const auto shifted = [&](ElementId e) { return e < last ? e : ElementId(e.value - gone); };
  std::vector<EdgeId> renumbered(size(), EdgeId::none());
  const auto isGone = [&](ElementId e) { return e >= first && e < last; };
  std::size_t kept = 0;
  keepRows(columns(), size(), [&](std::size_t i) {
    const bool stays = !isGone(element[i][0]) && !isGone(element[i][1]);
    if (stays) renumbered[i] = EdgeId(kept++);
    return stays;
  });
  ofElement.assign(model.triangles.size(), kNoEdges);
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      element[i][k] = shifted(element[i][k]);
      ofElement[element[i][k].value][corner[i][k]] = EdgeId(i);
    }
  std::vector<ElementId> elementOf(model.nodes.size(), ElementId::none());
  for (std::size_t n = 0; n < ofNode.size(); ++n)
    if (renumberedNodes[n] != NodeId::none() && ofNode[n] != ElementId::none())
      elementOf[renumberedNodes[n].value] = shifted(ofNode[n]);
  ofNode = std::move(elementOf);
  return renumbered;
}

Side CrackEdges::twin(Side side) const {
  const EdgeId edge = ofElement[side.element.value][side.corner];
  if (edge == EdgeId::none()) return {ElementId::none(), 0};
  return this->side(edge, element[edge.value][0] == side.element ? 1 : 0);
}

bool CrackEdges::appendFan(const Model& model, NodeId node, std::vector<ElementId>& fan) const {
  const ElementId start = ofNode[node.value];
  assert(start != ElementId::none());
  const auto begin = std::ssize(fan);
  const auto counterClockwise = [&](ElementId e) {
    return across({e, beforeCorner(cornerOf(model, e, node))});
  };
  for (ElementId e = start; e != ElementId::none();) {
    fan.push_back(e);
    e = counterClockwise(e);
    if (e == start) return true;
  }
  // The part before `start`, from there back to the other face.
  const auto former = std::ssize(fan);
  const auto clockwise = [&](ElementId e) {
    return across({e, static_cast<std::uint8_t>(cornerOf(model, e, node))});
  };
  for (ElementId e = clockwise(start); e != ElementId::none(); e = clockwise(e)) fan.push_back(e);
  std::reverse(fan.begin() + former, fan.end());
  std::rotate(fan.begin() + begin, fan.begin() + former, fan.end());
  return false;
}

}  // namespace yadefrag
