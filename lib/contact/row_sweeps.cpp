#include "contact/row_sweeps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/tolerances/solver.hpp"

namespace yadefrag {

double RowSweeps::solve(std::span<ContactRow> rows, const Inertia& inertia, Stop stop,
                        Coupling* coupling) {
  const std::size_t former = rows_.size();
  assert(former <= rows.size());
  numbers_.resize(inertia.size());
  waiting_.grow(rows.size());
  for (std::size_t r = 0; r < former; ++r) update(r, rows[r], stop.change);
  for (const ContactRow& row : rows.subspan(former)) add(row, inertia);
  if (rows_.size() > former) findRowsOfNodes(), groups_ = {};
  pushAll();
  share(coupling, inertia.nodes.size());
  return finish(rows, stop, coupling);
}

double RowSweeps::finish(std::span<ContactRow> rows, Stop stop, Coupling* coupling) {
  double change = 0;
  const auto goesOn = [&] {
    return count_ < stop.most ||
           (count_ < tolerance::kMostSweeps && change > tolerance::kFarFromSolved * stop.change);
  };
  for (count_ = 0; goesOn();) {
    // Alternating directions: forces are transmitted along chains of pieces.
    change = sweep(count_++ % 2 == 0, stop.change), ++total_;
    if (!shared_.empty() && count_ % tolerance::kSweepsToCouple == 1)
      change = std::max(change, sweepCoupled(*coupling, stop.change));
    if (!(change > stop.change)) break;
    if (count_ >= tolerance::kSweepsToDescend) descend(stop.change);
  }
  if (!shared_.empty()) (void)sweepCoupled(*coupling, stop.change, true);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].normalForce = rows_[r].normalForce;
    rows[r].tangentForce = rows_[r].tangentForce;
  }
  return change;
}

/// Finds the nodes of rows that coupled forces move, too.
void RowSweeps::share(const Coupling* coupling, std::size_t modelNodes) {
  shared_.clear();
  if (coupling == nullptr) return;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].value < modelNodes && coupling->group[nodes_[i].value] != 0)
      shared_.push_back({i, nodes_[i]});
  if (!shared_.empty()) coupling->forces.begin(coupling->position);
}

/// One sweep of the coupled forces, at the positions with the present contact forces; in the `last`
/// one they converge. Returns the largest displacement (m).
double RowSweeps::sweepCoupled(Coupling& coupling, double tolerance, bool last) {
  for (SharedNode& one : shared_) {
    const Vec2 byContact = moved_.nodes[one.number].shift - one.byOthers;
    if (norm(byContact - one.byContact) > (last ? 0 : tolerance) || !one.isKnown)
      coupling.forces.noteMoved(one.node);
    one.byContact = byContact, one.isKnown = true;
    Vec2& at = coupling.position[one.node.value];
    at += byContact - coupling.displaced[one.node.value];
    one.at = at;
  }
  const double most = last ? coupling.forces.converge(coupling.position)
                           : coupling.forces.sweep(coupling.position, tolerance);
  for (SharedNode& one : shared_) {
    Vec2& at = coupling.position[one.node.value];
    const Vec2 change = at - one.at;
    at = at - (one.byContact - coupling.displaced[one.node.value]);
    one.byOthers += change;
    moved_.nodes[one.number].shift += change;
    if (norm(change) > tolerance)
      for (const std::uint32_t row : rowsOfNodes_.row(one.number)) waiting_.add(row);
  }
  if (last) coupling.moved = most;
  return most;
}

void RowSweeps::clear() {
  nodes_.clear();
  moved_.nodes.clear();
  turns_.clear();
  rows_.clear();
  ends_.clear();
  waiting_.clear(0);
  schedules_.clear();
  groups_ = {};
  total_ = 0;
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
  waiting_.add(rows_.size() - 1);
}

/// A row that was swept in an earlier detection of the step.
void RowSweeps::update(std::size_t r, const ContactRow& row, double tolerance) {
  SweepRow& swept = rows_[r];
  const double gap = row.gap - row.toleratedGap;
  bool differs = std::abs(gap - swept.gap) > tolerance;
  swept.gap = gap;
  if (swept.friction > 0) {
    differs = differs || std::abs(row.slip - swept.slip) > tolerance;
    swept.slip = row.slip;
  }
  if (differs) waiting_.add(r);
}

/// Displacements by the forces of all rows.
void RowSweeps::pushAll() {
  for (MovedNode& node : moved_.nodes) node.shift = {};
  moved_.turns.assign(turns_.empty() ? 0 : nodes_.size(), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    push(rows_[r], ends_[r], ends_[r].count, rows_[r].force(), moved_);
}

void RowSweeps::addEnd(SweepRow& swept, Ends& ends, NodeId number, double weight,
                       const Inertia& inertia) {
  const std::uint32_t node = ends.node[ends.count] = numberOf(number, inertia);
  swept.weight[ends.count++] = weight;
  const Vec2 mobile = weight * weight * moved_.nodes[node].perForce;
  swept.normalResponse += weighted(swept.normal, mobile, swept.normal);
  if (!(swept.friction > 0)) return;
  swept.tangentResponse += weighted(swept.along(), mobile, swept.along());
  swept.slipPerNormal += weighted(swept.normal, mobile, swept.along());
}

void RowSweeps::addRigid(SweepRow& swept, Ends& ends, const ContactRow::RigidPart& part,
                         const Inertia& inertia) {
  const NodeId number(inertia.nodes.size() + part.mass);
  addEnd(swept, ends, number, part.weight, inertia);
  const double turning = inertia.step.squared() * inertia.turningOf(number);
  const double normal = cross(part.lever, swept.normal);
  const double tangent = cross(part.lever, Vec2{-swept.normal.y, swept.normal.x});
  swept.normalResponse += turning * normal * normal;
  swept.tangentResponse += turning * tangent * tangent;
  swept.slipPerNormal += turning * normal * tangent;
  ends.turn = static_cast<std::uint32_t>(turns_.size());
  turns_.push_back({part.lever, turning, ends.node[ends.count - 1]});
}

std::uint32_t RowSweeps::numberOf(NodeId node, const Inertia& inertia) {
  std::uint32_t& number = numbers_[node.value];
  if (number < nodes_.size() && nodes_[number] == node) return number;
  number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  moved_.nodes.push_back({{}, inertia.step.squared() * inertia.mobilityOf(node)});
  return number;
}

void RowSweeps::findRowsOfNodes() {
  links_.clear();
  for (std::uint32_t r = 0; r < ends_.size(); ++r)
    for (std::uint32_t k = 0; k < ends_[r].count; ++k) links_.push_back({ends_[r].node[k], r});
  fillRows(
      rowsOfNodes_, nodes_.size(), links_.size(), [&](std::size_t i) { return links_[i].node; },
      [&](std::size_t i) { return links_[i].row; });
}

double RowSweeps::sweep(bool forwards, double tolerance) {
  double most = 0;
  const auto visit = [&](std::size_t r) {
    const Ends& ends = ends_[r];
    // A corner against a straight piece, as most rows: loops of constant length.
    const double moved = ends.count == 3
                             ? relax(rows_[r], ends, std::integral_constant<std::uint32_t, 3>{})
                             : relax(rows_[r], ends, ends.count);
    most = std::max(most, moved);
    if (!(moved > tolerance)) return;
    for (std::uint32_t k = 0; k < ends.count; ++k)
      for (const std::uint32_t other : rowsOfNodes_.row(ends.node[k])) waiting_.add(other);
    // Its own gap is 0 now, unless friction has turned a rigid body.
    if (ends.turn == kNone) waiting_.remove(r);
  };
  if (forwards)
    waiting_.visitUp(visit);
  else
    waiting_.visitDown(visit);
  return most;
}

/// Sets one row's forces so that its own gap and slip vanish, within the bounds; returns the
/// displacement that this causes (m). A row whose nodes are all held is skipped.
template <class Count>
double RowSweeps::relax(SweepRow& row, const Ends& ends, Count count) {
  if (!(row.normalResponse > 0)) return 0;
  const Vec2 moved = relativeMotion(row, ends, count, moved_);
  const double gap = row.gap + dot(moved, row.normal);
  const double normal = std::max(0., row.normalForce - gap / row.normalResponse);
  const double pushed = normal - row.normalForce;
  row.normalForce = normal;
  double pulled = 0, slid = 0;
  if (row.tangentResponse > 0) {  // only with friction
    const double slip = row.slip + dot(moved, row.along()) + pushed * row.slipPerNormal;
    const double most = row.friction * normal;
    const double tangent = std::clamp(row.tangentForce - slip / row.tangentResponse, -most, most);
    pulled = tangent - row.tangentForce, slid = std::abs(pulled) * row.tangentResponse;
    row.tangentForce = tangent;
  }
  if (pushed == 0 && pulled == 0) return 0;
  push(row, ends, count, pushed * row.normal + pulled * row.along(), moved_);
  return std::max(std::abs(pushed) * row.normalResponse, slid);
}

}  // namespace yadefrag
