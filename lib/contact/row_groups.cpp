// RowSweeps: rows in the form for the sweeps, and their groups. Forces of one group do not move the
// nodes of another. A node that cannot move belongs to no group, since it transmits no force.

#include <algorithm>
#include <cmath>

#include "contact/row_sweeps.hpp"
#include "core/disjoint_sets.hpp"

namespace yadefrag {

void RowSweeps::clear() {
  order_.clear();
  waits_.clear();
  attempts_.clear();
  groups_.clear();
  rows_.clear();
  ends_.clear();
  turns_.clear();
  nodes_.clear();
  moved_.nodes.clear();
}

void RowSweeps::add(const ContactRow& row, const Inertia& inertia) {
  SweepRow& swept = rows_.emplace_back();
  Ends& ends = ends_.emplace_back();
  swept.normal = row.normal;
  swept.gap = row.gap - row.toleratedGap, swept.slip = row.slip, swept.friction = row.friction;
  swept.normalForce = row.normalForce, swept.tangentForce = row.tangentForce;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(row.count); ++k)
    if (!row.isOfRigid(inertia.nodes, row.node[k]))
      addEnd(swept, ends, row.node[k], row.weight[k], inertia);
  if (row.rigid.mass != ContactRow::kNone) addRigid(swept, ends, row.rigid, inertia);
}

void RowSweeps::addEnd(SweepRow& swept, Ends& ends, NodeId number, double weight,
                       const Inertia& inertia) {
  const std::uint32_t node = numberOf(number, inertia);
  const Vec2 perForce = moved_.nodes[node].perForce;
  if (perForce == Vec2{} && inertia.turningOf(number) == 0) return;
  ends.node[ends.count] = node;
  swept.weight[ends.count++] = weight;
  const Vec2 mobile = weight * weight * perForce;
  swept.normalResponse += weighted(swept.normal, mobile, swept.normal);
  if (!(swept.friction > 0)) return;
  swept.tangentResponse += weighted(swept.along(), mobile, swept.along());
  swept.slipPerNormal += weighted(swept.normal, mobile, swept.along());
}

void RowSweeps::addRigid(SweepRow& swept, Ends& ends, const ContactRow::RigidPart& part,
                         const Inertia& inertia) {
  const NodeId number(inertia.nodes.size() + part.mass);
  const std::uint32_t former = ends.count;
  addEnd(swept, ends, number, part.weight, inertia);
  if (ends.count == former) return;
  const double turning = inertia.step.squared() * inertia.turningOf(number);
  const double normal = cross(part.lever, swept.normal);
  const double tangent = cross(part.lever, Vec2{-swept.normal.y, swept.normal.x});
  swept.normalResponse += turning * normal * normal;
  swept.tangentResponse += turning * tangent * tangent;
  swept.slipPerNormal += turning * normal * tangent;
  ends.turn = static_cast<std::uint32_t>(turns_.size());
  turns_.push_back({part.lever, turning, ends.node[former]});
}

std::uint32_t RowSweeps::numberOf(NodeId node, const Inertia& inertia) {
  std::uint32_t& number = numbers_[node.value];
  if (number < nodes_.size() && nodes_[number] == node) return number;
  number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  moved_.nodes.push_back({{}, inertia.step.squared() * inertia.mobilityOf(node)});
  return number;
}

/// Rows of an earlier detection of the step: which of them have another gap or slip now?
void RowSweeps::update(std::span<const ContactRow> rows, double tolerance) {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    SweepRow& swept = rows_[r];
    const ContactRow& row = rows[order_[r]];
    swept.normalForce = row.normalForce, swept.tangentForce = row.tangentForce;
    const double gap = row.gap - row.toleratedGap;
    bool differs = waits_[r] != 0 || std::abs(gap - swept.gap) > tolerance;
    swept.gap = gap;
    if (swept.friction > 0) {
      differs = differs || std::abs(row.slip - swept.slip) > tolerance;
      swept.slip = row.slip;
    }
    waits_[r] = differs ? 1 : 0;
  }
}

/// All rows as one group, in their present order.
void RowSweeps::makeOneGroup() {
  groups_.assign(1, {0, static_cast<std::uint32_t>(rows_.size()), 0});
  isDivided_ = false;
  waiting_.clear(rows_.size());
  findWaiting();
}

/// Divides this group: rows of a group are then next to each other. Where few sweeps are
/// sufficient, that would not pay.
void RowSweeps::divide() {
  const Group all = groups_.front();
  keepWaiting();
  const Csr<std::uint32_t> members = findGroups();
  const auto arrange = [&](auto& values) {
    auto former = values;
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = former[members.values[r]];
  };
  arrange(rows_), arrange(ends_), arrange(order_), arrange(waits_);
  groups_.clear();
  std::size_t waiting = 0;
  for (std::size_t g = 0; g < members.rows(); ++g) {
    Group& group = groups_.emplace_back(all);
    group.begin = members.offsets[g], group.end = members.offsets[g + 1];
    group.firstWaiting = waiting;
    waiting += WorkList::kPerWord * WorkList::wordsFor(group.size());
  }
  isDivided_ = true;
  waiting_.clear(waiting);
  findWaiting();
  makeRoomForGradients();
}

Csr<std::uint32_t> RowSweeps::findGroups() const {
  DisjointSets sets(rows_.size());
  std::vector<std::uint32_t> rowOfNode(nodes_.size(), kNone);
  for (std::uint32_t r = 0; r < rows_.size(); ++r)
    for (std::uint32_t k = 0; k < ends_[r].count; ++k) {
      std::uint32_t& first = rowOfNode[ends_[r].node[k]];
      if (first == kNone)
        first = r;
      else
        sets.join(first, r);
    }
  std::vector<std::uint32_t> groupOfRow;
  const std::uint32_t count = sets.number(groupOfRow);
  Csr<std::uint32_t> members;
  fillRows(
      members, count, rows_.size(), [&](std::size_t r) { return groupOfRow[r]; },
      [](std::size_t r) { return static_cast<std::uint32_t>(r); });
  return members;
}

/// Numbers in `waiting_`: of the rows that wait, and of those of each node.
void RowSweeps::findWaiting() {
  links_.clear();
  for (const Group& group : groups_)
    for (std::uint32_t r = group.begin; r < group.end; ++r) {
      const auto number = static_cast<std::uint32_t>(group.waitingOf(r));
      if (waits_[r] != 0) waiting_.add(number);
      for (std::uint32_t k = 0; k < ends_[r].count; ++k)
        links_.push_back({ends_[r].node[k], number});
    }
  fillRows(
      rowsOfNodes_, nodes_.size(), links_.size(), [&](std::size_t i) { return links_[i].node; },
      [&](std::size_t i) { return links_[i].row; });
}

void RowSweeps::keepWaiting() {
  for (const Group& group : groups_)
    for (std::uint32_t r = group.begin; r < group.end; ++r)
      waits_[r] = waiting_.contains(group.waitingOf(r)) ? 1 : 0;
}

/// For later solutions of the step.
void RowSweeps::countSweeps() {
  if (!isDivided_) return;
  for (const Group& group : groups_) attempts_[order_[group.begin]].former += group.sweeps;
}

/// Displacements by the forces of all rows.
void RowSweeps::pushAll() {
  for (MovedNode& node : moved_.nodes) node.shift = {};
  moved_.turns.assign(turns_.empty() ? 0 : nodes_.size(), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r) push(rows_[r], ends_[r], rows_[r].force(), moved_);
}

}  // namespace yadefrag
