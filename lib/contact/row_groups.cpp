// RowSweeps: rows in the form for the sweeps, and their groups. Forces of one group do not move the
// nodes of another. A node that cannot move belongs to no group, since it transmits no force.

#include <algorithm>
#include <cmath>

#include "contact/row_sweeps.hpp"
#include "core/disjoint_sets.hpp"

namespace yadefrag {

void RowSweeps::clear() {
  found_.clear();
  foundEnds_.clear();
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
  SweepRow& swept = found_.emplace_back();
  Ends& ends = foundEnds_.emplace_back();
  swept.normal = row.normal;
  swept.gap = row.gap - row.toleratedGap, swept.slip = row.slip, swept.friction = row.friction;
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
  for (std::size_t r = 0; r < rows.size(); ++r) {
    SweepRow& swept = found_[r];
    const double gap = rows[r].gap - rows[r].toleratedGap;
    bool differs = waits_[r] != 0 || std::abs(gap - swept.gap) > tolerance;
    swept.gap = gap;
    if (swept.friction > 0) {
      differs = differs || std::abs(rows[r].slip - swept.slip) > tolerance;
      swept.slip = rows[r].slip;
    }
    waits_[r] = differs ? 1 : 0;
  }
}

void RowSweeps::findGroups() {
  DisjointSets sets(found_.size());
  std::vector<std::uint32_t> rowOfNode(nodes_.size(), kNone);
  for (std::uint32_t r = 0; r < found_.size(); ++r)
    for (std::uint32_t k = 0; k < foundEnds_[r].count; ++k) {
      std::uint32_t& first = rowOfNode[foundEnds_[r].node[k]];
      if (first == kNone)
        first = r;
      else
        sets.join(first, r);
    }
  std::vector<std::uint32_t> groupOfRow;
  const std::uint32_t count = sets.number(groupOfRow);
  fillRows(
      order_, count, found_.size(), [&](std::size_t r) { return groupOfRow[r]; },
      [](std::size_t r) { return static_cast<std::uint32_t>(r); });
}

/// Rows of a group next to each other, with the forces of `rows`.
void RowSweeps::arrange(std::span<const ContactRow> rows) {
  const std::size_t count = found_.size();
  rows_.resize(count), ends_.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint32_t r = order_.values[p];
    rows_[p] = found_[r], ends_[p] = foundEnds_[r];
    rows_[p].normalForce = rows[r].normalForce, rows_[p].tangentForce = rows[r].tangentForce;
  }
  groups_.clear();
  std::size_t waiting = 0;
  for (std::size_t g = 0; g < order_.rows(); ++g) {
    const Group& group =
        groups_.emplace_back(Group{order_.offsets[g], order_.offsets[g + 1], waiting});
    constexpr std::size_t kWord = WorkList::kPerWord;
    waiting += (group.size() + kWord - 1) / kWord * kWord;
  }
  waiting_.clear(waiting);
  for (const Group& group : groups_)
    for (std::uint32_t r = group.begin; r < group.end; ++r)
      if (waits_[order_.values[r]] != 0) waiting_.add(group.waitingOf(r));
  findRowsOfNodes();
  attempts_.resize(count);
}

void RowSweeps::findRowsOfNodes() {
  links_.clear();
  for (const Group& group : groups_)
    for (std::uint32_t r = group.begin; r < group.end; ++r) {
      const auto number = static_cast<std::uint32_t>(group.waitingOf(r));
      for (std::uint32_t k = 0; k < ends_[r].count; ++k)
        links_.push_back({ends_[r].node[k], number});
    }
  fillRows(
      rowsOfNodes_, nodes_.size(), links_.size(), [&](std::size_t i) { return links_[i].node; },
      [&](std::size_t i) { return links_[i].row; });
}

/// Displacements by the forces of all rows.
void RowSweeps::pushAll() {
  for (MovedNode& node : moved_.nodes) node.shift = {};
  moved_.turns.assign(turns_.empty() ? 0 : nodes_.size(), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r) push(rows_[r], ends_[r], rows_[r].force(), moved_);
}

}  // namespace yadefrag
