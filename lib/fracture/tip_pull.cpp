#include "fracture/separation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/tolerances/fracture.hpp"
#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

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

/// (m) Length of the crack that ends at `tip`, whose fan begins and ends at its faces; 0 for a
/// notch.
double crackAt(const Model& model, const CrackEdges& edges, std::span<const ElementId> fan,
               NodeId tip) {
  const Side first{fan.front(), static_cast<std::uint8_t>(cornerOf(model, fan.front(), tip))};
  const Side last{fan.back(), beforeCorner(cornerOf(model, fan.back(), tip))};
  const EdgeId edge = edges.ofElement[first.element.value][first.corner];
  const bool isCrack =
      edge != EdgeId::none() && edge == edges.ofElement[last.element.value][last.corner];
  return isCrack ? lengthOf(model, first) : 0;
}

/// (N/m) Force of an element's stress (Pa) on the node between `before` and `after`.
Vec2 forceOn(const std::array<double, 3>& stress, Vec2 after, Vec2 before) {
  const Vec2 out = rightOf(before - after);
  return .5 * Vec2{stress[0] * out.x + stress[2] * out.y, stress[2] * out.x + stress[1] * out.y};
}

}  // namespace

bool isTip(const Model& model, std::span<const ElementId> fan, NodeId node) {
  return angleOf(model, fan, node) > tolerance::kTipAngle;
}

Vec2 normalOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const Side side = edges.side(edge, 0);
  const Vec2 across = rightOf(model.nodes.position[lastNode(model, side).value] -
                              model.nodes.position[firstNode(model, side).value]);
  return (1 / norm(across)) * across;
}

Traction tipTraction(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId tip,
                     std::span<const ElementId> fan) {
  const auto placeOf = [&](int which) {
    return std::find(fan.begin(), fan.end(), edges.side(edge, which).element) - fan.begin();
  };
  const auto first = placeOf(0), second = placeOf(1);
  std::array<Vec2, 2> force{};   // N/m, on the node's parts at the first and second triangle
  std::array<double, 2> mass{};  // per thickness and density of the first triangle
  const double density = model.materialOf(fan.front()).material.density;
  for (std::ptrdiff_t i = 0; i < std::ssize(fan); ++i) {
    const ElementId element = fan[static_cast<std::size_t>(i)];
    const std::size_t part = (i <= std::min(first, second)) == (first < second) ? 0 : 1;
    const auto [after, before] = oppositeEnds(model, element, tip);
    const double depth = model.depthOf(element) / model.depthOf(fan.front());
    force[part] += depth * forceOn(stressOf(model, element), after, before);
    mass[part] += depth * model.materialOf(element).material.density / density *
                  model.triangles.area[element.value];
  }
  // The force between the two parts when both move with the same acceleration.
  const Vec2 pull = (1 / (mass[0] + mass[1])) * (mass[1] * force[0] - mass[0] * force[1]);
  const double length =
      (lengthOf(model, edges.side(edge, 0)) + crackAt(model, edges, fan, tip)) / 2;
  const Vec2 normal = normalOf(model, edges, edge);
  return {-dot(normal, pull) / length, cross(pull, normal) / length};
}

double otherPull(const Model& model, const CrackEdges& edges, EdgeId edge, NodeId tip,
                 std::span<const ElementId> fan) {
  double most = 0;
  for (const ElementId element : fan) {
    const auto corner = static_cast<std::uint8_t>(cornerOf(model, element, tip));
    const EdgeId other = edges.ofElement[element.value][corner];
    if (other == EdgeId::none() || other == edge || edges.cracked[other.value] != 0) continue;
    most = std::max(
        most, tipTraction(model, edges, other, tip, fan).normal / edges.strength[other.value]);
  }
  return most;
}

}  // namespace yadefrag
