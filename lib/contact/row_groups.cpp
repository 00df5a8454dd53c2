// RowSweeps: the groups of rows. Forces of one group do not move the nodes of another. A node that
// cannot move belongs to no group, since it transmits no force.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/row_sweeps.hpp"
#include "core/disjoint_sets.hpp"

namespace yadefrag {

void RowSweeps::clear() {
  order_.clear();
  waits_.clear();
  attempts_.clear();
  groups_.clear();
  system_.clear();
}

/// Rows of earlier detections of the step wait if their gap or slip has changed.
void RowSweeps::update(std::span<const ContactRow> rows, double tolerance) {
  assert(order_.size() == system_.rows.size() && waits_.size() == system_.rows.size());
  for (std::size_t r = 0; r < system_.rows.size(); ++r) {
    RowSystem::Row& swept = system_.rows[r];
    const ContactRow& row = rows[order_[r]];
    swept.normalForce = row.normalForce, swept.tangentForce = row.tangentForce;
    const double gap = row.gap - row.toleratedGap;
    bool differs = waits_[r] != 0 || std::abs(gap - swept.gap) > tolerance;
    swept.gap = gap;
    if (swept.friction > 0) {
      differs = differs || std::abs(row.slip - swept.slip) > tolerance || row.friction == 0;
      swept.slip = row.slip, swept.friction = row.friction;
    }
    waits_[r] = differs ? 1 : 0;
  }
}

/// All rows as one group, in their present order.
void RowSweeps::makeOneGroup() {
  groups_.assign(1, {{0, static_cast<std::uint32_t>(system_.rows.size())}, 0});
  isDivided_ = false;
  waiting_.clear(system_.rows.size());
  findWaiting();
}

/// Divides this group: rows of a group are then next to each other. Where few sweeps are
/// sufficient, the division would take longer than it saves.
void RowSweeps::divide() {
  assert(groups_.size() == 1 && !isDivided_);
  const Group all = groups_.front();
  keepWaiting();
  const Csr<std::uint32_t> members = findGroups();
  const auto arrange = [&](auto& values) {
    auto former = values;
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = former[members.values[r]];
  };
  arrange(system_.rows), arrange(system_.ends), arrange(order_), arrange(waits_);
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
  gradients_.makeRoom(system_);
}

Csr<std::uint32_t> RowSweeps::findGroups() const {
  DisjointSets sets(system_.rows.size());
  std::vector<std::uint32_t> rowOfNode(system_.nodes.size(), RowSystem::kNone);
  for (std::uint32_t r = 0; r < system_.rows.size(); ++r)
    for (std::uint32_t k = 0; k < system_.ends[r].count; ++k) {
      std::uint32_t& first = rowOfNode[system_.ends[r].node[k]];
      if (first == RowSystem::kNone)
        first = r;
      else
        sets.join(first, r);
    }
  std::vector<std::uint32_t> groupOfRow;
  const std::uint32_t count = sets.number(groupOfRow);
  Csr<std::uint32_t> members;
  fillRows(
      members, count, system_.rows.size(), [&](std::size_t r) { return groupOfRow[r]; },
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
      for (std::uint32_t k = 0; k < system_.ends[r].count; ++k)
        links_.push_back({system_.ends[r].node[k], number});
    }
  fillRows(
      rowsOfNodes_, system_.nodes.size(), links_.size(),
      [&](std::size_t i) { return links_[i].node; }, [&](std::size_t i) { return links_[i].row; });
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

}  // namespace yadefrag
