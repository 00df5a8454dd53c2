#include "contact/row_system.hpp"

#include <cassert>

namespace yadefrag {

void RowSystem::clear() {
  rows.clear();
  turns.clear();
  nodes.clear();
  moved.clear();
  turned.clear();
}

RowSystem::Row& RowSystem::add(const ContactRow& row, const Inertia& inertia) {
  if (numbers.size() < inertia.size()) numbers.resize(inertia.size());
  Row& added = rows.emplace_back();
  added.normal = row.normal;
  added.gap = row.gap - row.toleratedGap, added.slip = row.slip, added.friction = row.friction;
  added.normalForce = row.normalForce, added.tangentForce = row.tangentForce;
  added.normalResponse = added.tangentResponse = added.slipPerNormal = 0;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(row.count); ++k)
    if (!row.isOfRigid(inertia.nodes, row.node[k]))
      addEnd(added, row.node[k], row.weight[k], inertia);
  if (row.rigid.mass != ContactRow::kNone) addRigid(added, row.rigid, inertia);
  for (std::uint32_t k = added.count; k < kFew; ++k)
    added.node[k] = added.count > 0 ? added.node[0] : 0, added.weight[k] = 0;
  return added;
}

void RowSystem::addEnd(Row& row, NodeId number, double weight, const Inertia& inertia) {
  const std::uint32_t node = numberOf(number, inertia);
  const Vec2 perForce = moved[node].perForce;
  if (perForce == Vec2{} && inertia.turningOf(number) == 0) return;
  assert(row.count < row.node.size());
  row.node[row.count] = node;
  row.weight[row.count++] = weight;
  const Vec2 mobile = weight * weight * perForce;
  row.normalResponse += weighted(row.normal, mobile, row.normal);
  if (!(row.friction > 0)) return;
  row.tangentResponse += weighted(row.along(), mobile, row.along());
  row.slipPerNormal += weighted(row.normal, mobile, row.along());
}

void RowSystem::addRigid(Row& row, const ContactRow::RigidPart& part, const Inertia& inertia) {
  const NodeId number(inertia.nodes.size() + part.mass);
  const std::uint32_t former = row.count;
  addEnd(row, number, part.weight, inertia);
  if (row.count == former) return;
  const double turning = inertia.step.squared() * inertia.turningOf(number);
  const double normal = cross(part.lever, row.normal);
  const double tangent = cross(part.lever, row.along());
  row.normalResponse += turning * normal * normal;
  row.tangentResponse += turning * tangent * tangent;
  row.slipPerNormal += turning * normal * tangent;
  row.turn = static_cast<std::uint32_t>(turns.size());
  turns.push_back({part.lever, turning, row.node[former]});
}

std::uint32_t RowSystem::numberOf(NodeId node, const Inertia& inertia) {
  assert(node.value < numbers.size());
  std::uint32_t& number = numbers[node.value];
  if (number < nodes.size() && nodes[number] == node) return number;
  number = static_cast<std::uint32_t>(nodes.size());
  nodes.push_back(node);
  moved.push_back({{}, inertia.step.squared() * inertia.mobilityOf(node)});
  return number;
}

void RowSystem::linkLast() {
  assert(rows.size() > 1);
  Row& first = rows[rows.size() - 2];
  const Row& second = rows.back();
  if (first.turn != kNone || second.turn != kNone) return;  // RigidRows solves those of its body
  double sum = 0;
  for (std::uint32_t k = 0; k < first.count; ++k)
    for (std::uint32_t l = 0; l < second.count; ++l)
      if (first.node[k] == second.node[l])
        sum += first.weight[k] * second.weight[l] *
               weighted(first.normal, moved[first.node[k]].perForce, second.normal);
  first.cross = sum;
}

void RowSystem::pushAll() {
  for (MovedNode& node : moved) node.shift = {};
  turned.assign(turns.empty() ? 0 : nodes.size(), 0);
  for (const Row& row : rows) push(row, row.force());
}

}  // namespace yadefrag
