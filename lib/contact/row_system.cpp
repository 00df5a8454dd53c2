#include "contact/row_system.hpp"

#include <cassert>

namespace yadefrag {

void RowSystem::clear() {
  rows.clear();
  ends.clear();
  turns.clear();
  nodes.clear();
  moved.nodes.clear();
}

void RowSystem::add(const ContactRow& row, const Inertia& inertia) {
  Row& swept = rows.emplace_back();
  Ends& of = ends.emplace_back();
  swept.normal = row.normal;
  swept.gap = row.gap - row.toleratedGap, swept.slip = row.slip, swept.friction = row.friction;
  swept.normalForce = row.normalForce, swept.tangentForce = row.tangentForce;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(row.count); ++k)
    if (!row.isOfRigid(inertia.nodes, row.node[k]))
      addEnd(swept, of, row.node[k], row.weight[k], inertia);
  if (row.rigid.mass != ContactRow::kNone) addRigid(swept, of, row.rigid, inertia);
}

void RowSystem::addEnd(Row& swept, Ends& of, NodeId number, double weight, const Inertia& inertia) {
  const std::uint32_t node = numberOf(number, inertia);
  const Vec2 perForce = moved.nodes[node].perForce;
  if (perForce == Vec2{} && inertia.turningOf(number) == 0) return;
  assert(of.count < of.node.size());
  of.node[of.count] = node;
  swept.weight[of.count++] = weight;
  const Vec2 mobile = weight * weight * perForce;
  swept.normalResponse += weighted(swept.normal, mobile, swept.normal);
  if (!(swept.friction > 0)) return;
  swept.tangentResponse += weighted(swept.along(), mobile, swept.along());
  swept.slipPerNormal += weighted(swept.normal, mobile, swept.along());
}

void RowSystem::addRigid(Row& swept, Ends& of, const ContactRow::RigidPart& part,
                         const Inertia& inertia) {
  const NodeId number(inertia.nodes.size() + part.mass);
  const std::uint32_t former = of.count;
  addEnd(swept, of, number, part.weight, inertia);
  if (of.count == former) return;
  const double turning = inertia.step.squared() * inertia.turningOf(number);
  const double normal = cross(part.lever, swept.normal);
  const double tangent = cross(part.lever, Vec2{-swept.normal.y, swept.normal.x});
  swept.normalResponse += turning * normal * normal;
  swept.tangentResponse += turning * tangent * tangent;
  swept.slipPerNormal += turning * normal * tangent;
  of.turn = static_cast<std::uint32_t>(turns.size());
  turns.push_back({part.lever, turning, of.node[former]});
}

std::uint32_t RowSystem::numberOf(NodeId node, const Inertia& inertia) {
  assert(node.value < numbers.size());
  std::uint32_t& number = numbers[node.value];
  if (number < nodes.size() && nodes[number] == node) return number;
  number = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back(node);
  moved.nodes.push_back({{}, inertia.step.squared() * inertia.mobilityOf(node)});
  return number;
}

void RowSystem::pushAll() {
  for (MovedNode& node : moved.nodes) node.shift = {};
  moved.turns.assign(turns.empty() ? 0 : nodes.size(), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) push(rows[r], ends[r], rows[r].force(), moved);
}

}  // namespace yadefrag
