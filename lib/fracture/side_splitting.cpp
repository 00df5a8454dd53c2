#include "fracture/conform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "elements/element_state.hpp"
#include "elements/flowed_shape.hpp"
#include "fracture/edge_strength.hpp"
#include "mesh/assembly.hpp"

namespace yadefrag {
namespace {

using Weights = std::array<double, 3>;

/// Barycentric coordinates of a point near a triangle.
Weights weightsAt(const std::array<Vec2, 3>& x, Vec2 at) {
  const double whole = cross(x[1] - x[0], x[2] - x[0]);
  const double second = cross(at - x[0], x[2] - x[0]) / whole;
  const double third = cross(x[1] - x[0], at - x[0]) / whole;
  return {1 - second - third, second, third};
}

Vec2 combine(const Weights& weight, const std::array<NodeId, 3>& nodes,
             const std::vector<Vec2>& values) {
  Vec2 sum;
  for (std::size_t i = 0; i < 3; ++i) sum += weight[i] * values[nodes[i].value];
  return sum;
}

class Conformed {
 public:
  Conformed(Model& model, CrackEdges& edges) : model_(model), t_(model.triangles), edges_(edges) {}

  void move(std::span<const NodeMove> moves) {
    if (moves.empty()) return;
    std::vector<std::vector<ElementId>> fans(moves.size());
    std::map<NodeId, std::size_t> moveOf;
    for (std::size_t i = 0; i < moves.size(); ++i) moveOf[moves[i].node] = i;
    std::map<ElementId, Deformation> changed;
    for (std::size_t e = 0; e < t_.size(); ++e)
      for (const NodeId node : t_.nodes[e]) {
        const auto found = moveOf.find(node);
        if (found == moveOf.end() || t_.isDropped(e)) continue;
        fans[found->second].emplace_back(e);
        changed[ElementId(e)] = deformation(model_, ElementId(e));
      }
    std::vector<std::array<Vec2, 2>> carried;  // velocity and reference position
    for (std::size_t i = 0; i < moves.size(); ++i) carried.push_back(valuesAt(fans[i], moves[i]));
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const std::uint32_t node = moves[i].node.value;
      model_.nodes.position[node] = moves[i].to;
      if (model_.nodes.held[node] == kFree) model_.nodes.velocity[node] = carried[i][0];
      model_.nodes.reference[node] = carried[i][1];
    }
    for (const auto& [element, former] : changed) setShape(element, former);
  }

  /// Divides the triangle behind a side; the side that begins at the new node remains to be
  /// divided.
  NodeId divide(const NewNode& asked) {
    const Side side = present(asked.side);
    const std::size_t e = side.element.value, c = side.corner, c1 = afterCorner(side.corner),
                      c2 = beforeCorner(side.corner);
    const std::array<NodeId, 3> corners = t_.nodes[e];
    const Deformation former = deformation(model_, side.element);
    const NodeId node = addNode(corners, corners[c], corners[c1], asked);
    const ElementId added(t_.size());
    appendCopy(t_.columns(), e);
    t_.nodes[e][c1] = t_.nodes.back()[c] = node;
    setShape(side.element, former);
    setShape(added, former);
    divideEdges(side.element, added, corners[c1], node, c1, c2);
    moved_[{side.element, static_cast<std::uint8_t>(c1)}] = {added, static_cast<std::uint8_t>(c1)};
    moved_[asked.side] = {added, side.corner};
    return node;
  }

  /// Makes the triangles of each body consecutive again.
  void regroup() {
    std::vector<ElementId> order;
    for (std::size_t e = 0; e < t_.size(); ++e) order.emplace_back(e);
    std::ranges::stable_sort(order, {}, [&](ElementId e) { return t_.component[e.value]; });
    std::vector<ElementId> numberOf(t_.size());
    for (std::size_t i = 0; i < order.size(); ++i) numberOf[order[i].value] = ElementId(i);
    const std::span<const ElementId> former = order;
    arrangeRows(t_.columns(), former);
    if (!edges_.ofElement.empty()) arrange(edges_.ofElement, former);
    for (auto& both : edges_.element)
      for (ElementId& element : both) element = numberOf[element.value];
    for (ElementId& element : edges_.ofNode)
      if (element != ElementId::none()) element = numberOf[element.value];
    std::vector<std::uint32_t> counts(model_.components.size());
    for (const ComponentId component : t_.component) ++counts[component.value];
    std::uint32_t first = 0;
    for (std::size_t c = 0; c < counts.size(); ++c) {
      model_.components[c].firstTriangle = first;
      model_.components[c].lastTriangle = first += counts[c];
    }
  }

 private:
  [[nodiscard]] std::array<Vec2, 3> placesOf(ElementId element) const {
    const auto& nodes = t_.nodes[element.value];
    const auto& at = model_.nodes.position;
    return {at[nodes[0].value], at[nodes[1].value], at[nodes[2].value]};
  }

  /// The stress-free shape with this deformation at the present places: D⁻¹ = d⁻¹·F.
  void setShape(ElementId element, const Deformation& former) {
    const Matrix2& f = former.plane;
    const auto [x0, x1, x2] = placesOf(element);
    const Vec2 a = x1 - x0, b = x2 - x0;
    const double det = cross(a, b);
    const FlowedShape flowed(t_, element);
    t_.inverseEdges[element.value] = {
        (b.y * f.xx - b.x * f.yx) / det, (b.y * f.xy - b.x * f.yy) / det,
        (a.x * f.yx - a.y * f.xx) / det, (a.x * f.yy - a.y * f.xy) / det};
    t_.area[element.value] = det / 2 / determinant(f);
    if (model_.axisymmetric) t_.radius[element.value] = (x0.x + x1.x + x2.x) / (3 * former.hoop);
    flowed.keep(t_, element);
  }

  /// Of the triangle in which the place lies, or out of which it lies least.
  [[nodiscard]] std::array<Vec2, 2> valuesAt(const std::vector<ElementId>& fan,
                                             const NodeMove& move) const {
    double most = -INFINITY;
    std::array<Vec2, 2> values;
    for (const ElementId element : fan) {
      const Weights weight = weightsAt(placesOf(element), move.to);
      const double least = *std::ranges::min_element(weight);
      if (least <= most) continue;
      most = least;
      const auto& nodes = t_.nodes[element.value];
      values = {combine(weight, nodes, model_.nodes.velocity),
                combine(weight, nodes, model_.nodes.reference)};
    }
    return values;
  }

  NodeId addNode(const std::array<NodeId, 3>& corners, NodeId first, NodeId last,
                 const NewNode& asked) {
    Nodes& nodes = model_.nodes;
    const auto& place = nodes.position;
    const Weights weight = weightsAt(
        {place[corners[0].value], place[corners[1].value], place[corners[2].value]}, asked.at);
    const Vec2 velocity = combine(weight, corners, nodes.velocity);
    const Vec2 reference = combine(weight, corners, nodes.reference);
    const bool isSame =
        nodes.motion.empty() || nodes.motion[first.value] == nodes.motion[last.value];
    const NodeId node = nodes.duplicate(first);
    nodes.position[node.value] = asked.at;
    nodes.velocity[node.value] = velocity;
    nodes.reference[node.value] = reference;
    if (!nodes.load.empty()) nodes.load[node.value] = {};
    nodes.held[node.value] &= isSame ? nodes.held[last.value] : std::uint8_t{kFree};
    if (nodes.motion.empty()) return node;
    if (nodes.held[node.value] == kFree) nodes.motion[node.value] = 0;
    // The arms of one motion differ as the places do, except for the motion's rotation.
    const double part =
        dot(asked.at - place[first.value], place[last.value] - place[first.value]) /
        dot(place[last.value] - place[first.value], place[last.value] - place[first.value]);
    nodes.arm[node.value] += part * (nodes.arm[last.value] - nodes.arm[first.value]);
    return node;
  }

  /// The side as it is after earlier divisions.
  [[nodiscard]] Side present(Side side) const {
    for (auto found = moved_.find(side); found != moved_.end(); found = moved_.find(side))
      side = found->second;
    return side;
  }

  /// `last`: the end of the divided side; the corners c1, c2 follow the one at which it begins.
  void divideEdges(ElementId divided, ElementId added, NodeId last, NodeId node, std::size_t c1,
                   std::size_t c2) {
    if (edges_.ofElement.empty()) return;
    edges_.ofElement.resize(t_.size(), {EdgeId::none(), EdgeId::none(), EdgeId::none()});
    edges_.ofNode.resize(model_.nodes.size(), ElementId::none());
    auto& own = edges_.ofElement[divided.value];
    auto& others = edges_.ofElement[added.value];
    const std::array former{own[c1], own[c2]};
    others[c1] = std::exchange(own[c1], EdgeId::none());
    if (others[c1] != EdgeId::none())
      for (ElementId& element : edges_.element[others[c1].value])
        if (element == divided) element = added;
    if (edges_.ofNode[last.value] == ElementId::none()) return;  // a body that does not crack
    if (edges_.ofNode[last.value] == divided) edges_.ofNode[last.value] = added;
    edges_.ofNode[node.value] = divided;
    const auto [strength, energy] = strengthOf(divided, added, former);
    edges_.append({divided, static_cast<std::uint8_t>(c1)}, {added, static_cast<std::uint8_t>(c2)},
                  strength, energy, false);
  }

  /// Strength and fracture energy of the new edge. With strengths by place: those of the stronger
  /// edge of the triangle, since the other one may be a joint.
  [[nodiscard]] std::pair<double, double> strengthOf(ElementId divided, ElementId added,
                                                     const std::array<EdgeId, 2>& former) const {
    const Component& body = model_.bodyOf(divided);
    const BrittleMaterial material = model_.materialOf(divided).brittle;
    if (!body.brittleByPlace) {
      // No other edge of the body has this number.
      const std::uint64_t number =
          std::uint64_t{t_.component[divided.value].value} << 32 | ((edges_.size() + 1) | 1U << 31);
      const double area = t_.area[divided.value] + t_.area[added.value];
      return {edgeStrength(material, number, model_.depthOf(divided) * area / 3),
              material.fractureEnergy};
    }
    double strength = 0, energy = material.fractureEnergy;
    for (const EdgeId edge : former) {
      if (edge == EdgeId::none() || edges_.isBond(model_, edge) || isRaised(edge) ||
          edges_.strength[edge.value] <= strength)
        continue;
      strength = edges_.strength[edge.value], energy = edges_.fractureEnergy[edge.value];
    }
    return {strength > 0 ? strength : material.tensileStrength, energy};
  }

  /// True for a crack that may have the strength of its strain rate.
  [[nodiscard]] bool isRaised(EdgeId edge) const {
    const auto [a, b] = edges_.element[edge.value];
    return edges_.cracked[edge.value] != 0 && materialBetween(model_, a, b).brittle.rate.isOn();
  }

  Model& model_;
  Triangles& t_;
  CrackEdges& edges_;
  std::map<Side, Side> moved_;  // sides that are sides of a new triangle now
};

/// The boundary sides with new nodes, and those after them, where `relink` makes corners.
DividedSides dividedSides(const Model& model, const ContactSurfaces& surfaces,
                          const ConformPlan& plan, std::span<const NodeId> begins,
                          std::span<const NodeId> added) {
  DividedSides result;
  std::set<SegmentId> listed;
  std::vector<SegmentId> following;
  for (std::size_t i = 0; i < added.size();) {
    const Side side = plan.newNodes[i].side;
    NodeId begin = begins[i];
    const SegmentId segment = surfaces.nodeSegment[begin.value];
    const NodeId end = surfaces.segmentNode[surfaces.segmentNext[segment.value].value];
    const ComponentId component = model.nodes.component[begin.value];
    listed.insert(segment);
    following.push_back(surfaces.segmentNext[segment.value]);
    SegmentId own = segment;
    for (; i < added.size() && plan.newNodes[i].side == side; ++i) {
      result.sides.push_back({own, begin, added[i], component});
      begin = added[i], own = SegmentId::none();
      result.parents.push_back(segment);
    }
    result.sides.push_back({own, begin, end, component});
  }
  for (const SegmentId segment : following) {
    if (!listed.insert(segment).second) continue;
    const NodeId begin = surfaces.segmentNode[segment.value];
    const NodeId end = surfaces.segmentNode[surfaces.segmentNext[segment.value].value];
    result.sides.push_back({segment, begin, end, model.nodes.component[begin.value]});
  }
  return result;
}

}  // namespace

DividedSides conform(Model& model, CrackEdges& edges, const ContactSurfaces& surfaces,
                     const ConformPlan& plan) {
  Conformed mesh(model, edges);
  mesh.move(plan.moves);
  std::vector<NodeId> begins, added;
  for (const NewNode& one : plan.newNodes) begins.push_back(firstNode(model, one.side));
  for (const NewNode& one : plan.newNodes) added.push_back(mesh.divide(one));
  DividedSides divided = dividedSides(model, surfaces, plan, begins, added);
  mesh.regroup();
  lumpMasses(model);
  return divided;
}

}  // namespace yadefrag
