#include "contact/row_sweeps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/parallel.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag {

double RowSweeps::solve(std::span<ContactRow> rows, const Inertia& inertia, Stop stop,
                        Coupling* coupling, int threads) {
  const std::size_t former = system_.rows.size();
  assert(former <= rows.size() && !rows.empty());
  system_.numbers.resize(inertia.size());
  update(rows, stop.change);
  for (const ContactRow& row : rows.subspan(former)) system_.add(row, inertia);
  waits_.resize(rows.size(), 1), attempts_.resize(rows.size());
  for (std::size_t r = former; r < rows.size(); ++r)
    order_.push_back(static_cast<std::uint32_t>(r));
  makeOneGroup();
  system_.pushAll();
  share(coupling, inertia.nodes.size());
  const double change = sweepAll(stop, coupling, threads);
  keepWaiting();
  countSweeps();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    ContactRow& row = rows[order_[r]];
    row.normalForce = system_.rows[r].normalForce, row.tangentForce = system_.rows[r].tangentForce;
  }
  return change;
}

/// Coupled forces are improved between the sweeps of the groups.
double RowSweeps::sweepAll(Stop stop, Coupling* coupling, int threads) {
  const bool isCoupled = !shared_.empty();
  const int most = std::max(stop.most, tolerance::kMostSweeps);
  double change = INFINITY;
  for (int done = 0, until = isCoupled ? 1 : tolerance::kSweepsToDivide; change > stop.change;) {
    const bool isFar = change > tolerance::kFarFromSolved * stop.change;
    if (done >= (isFar ? most : stop.most)) break;
    if (done >= tolerance::kSweepsToDivide && !isDivided_) divide();
    change = sweepGroups(until, stop, threads);
    if (isCoupled) change = std::max(change, sweepCoupled(*coupling, stop.change));
    done = until, until = isCoupled ? until + tolerance::kSweepsToCouple : most;
  }
  if (isCoupled) (void)sweepCoupled(*coupling, stop.change, true);
  return change;
}

/// At most `until` sweeps of each group since the begin of the solution. Returns the largest change
/// in the last one (m).
double RowSweeps::sweepGroups(int until, Stop stop, int threads) {
  forEachItem(groups_.size(), system_.rows.size(), threads,
              [&](std::size_t g) { sweepGroup(groups_[g], until, stop); });
  double change = 0;
  count_ = 0;
  for (const Group& group : groups_)
    change = std::max(change, group.change), count_ = std::max(count_, group.sweeps);
  return change;
}

void RowSweeps::sweepGroup(Group& group, int until, Stop stop) {
  const auto goesOn = [&] {
    return group.sweeps < until &&
           (group.sweeps < stop.most || group.change > tolerance::kFarFromSolved * stop.change);
  };
  while (goesOn()) {
    // Alternating directions: forces are transmitted along chains of rows.
    group.change = sweep(group, group.sweeps++ % 2 == 0, stop.change);
    if (!(group.change > stop.change)) break;
    if (group.sweeps >= tolerance::kSweepsToDescend) descendIfDue(group, stop.change);
  }
}

void RowSweeps::descendIfDue(const Group& group, double tolerance) {
  Attempts& attempts = attempts_[order_[group.begin]];
  const int sweeps = attempts.former + group.sweeps;
  if (sweeps < attempts.next) return;
  if (!(gradients_.findResiduals(system_, group) > tolerance))
    attempts.between = tolerance::kSweepsToDescend;
  else if (descend(group, tolerance))
    attempts.between = tolerance::kSweepsAfterDescent;
  else
    attempts.between =
        std::max(tolerance::kMoreSweeps * attempts.between, tolerance::kSweepsToDescend);
  attempts.next = sweeps + attempts.between;
}

/// All rows of the group wait afterwards. Returns false if a force has reached a bound.
bool RowSweeps::descend(const Group& group, double tolerance) {
  const bool isFree = gradients_.descend(system_, group, tolerance);
  for (std::uint32_t r = group.begin; r < group.end; ++r) waiting_.add(group.waitingOf(r));
  return isFree;
}

/// Finds the nodes of rows that coupled forces move, too.
void RowSweeps::share(const Coupling* coupling, std::size_t modelNodes) {
  shared_.clear();
  if (coupling == nullptr) return;
  for (std::uint32_t i = 0; i < system_.nodes.size(); ++i)
    if (system_.nodes[i].value < modelNodes &&
        coupling->forces.groupOf(system_.nodes[i]) != CoupledForces::kNoGroup)
      shared_.push_back({i, system_.nodes[i]});
  if (!shared_.empty()) coupling->forces.begin(coupling->position);
}

/// One sweep of the coupled forces, at the positions with the present contact forces; in the `last`
/// one they converge. Returns the largest displacement (m).
double RowSweeps::sweepCoupled(Coupling& coupling, double tolerance, bool last) {
  for (SharedNode& one : shared_) {
    const Vec2 byContact = system_.moved.nodes[one.number].shift - one.byOthers;
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
    system_.moved.nodes[one.number].shift += change;
    if (norm(change) > tolerance)
      for (const std::uint32_t row : rowsOfNodes_.row(one.number)) waiting_.add(row);
  }
  if (last) coupling.moved = most;
  return most;
}

double RowSweeps::sweep(const Group& group, bool forwards, double tolerance) {
  double most = 0;
  const auto visit = [&](std::size_t waiting) {
    const std::size_t r = group.begin + (waiting - group.firstWaiting);
    const RowSystem::Ends& ends = system_.ends[r];
    // A corner against a corner or a straight piece, as most rows: loops of constant length.
    const double moved =
        ends.count == 3   ? relax(system_.rows[r], ends, std::integral_constant<std::uint32_t, 3>{})
        : ends.count == 2 ? relax(system_.rows[r], ends, std::integral_constant<std::uint32_t, 2>{})
                          : relax(system_.rows[r], ends, ends.count);
    most = std::max(most, moved);
    if (!(moved > tolerance)) return;
    for (std::uint32_t k = 0; k < ends.count; ++k)
      for (const std::uint32_t other : rowsOfNodes_.row(ends.node[k])) waiting_.add(other);
    // Its own gap is 0 now, unless friction has turned a rigid body.
    if (ends.turn == RowSystem::kNone) waiting_.remove(waiting);
  };
  if (forwards)
    waiting_.visitUp(group.words(), visit);
  else
    waiting_.visitDown(group.words(), visit);
  return most;
}

/// Sets one row's forces so that its own gap and slip vanish, within the bounds; returns the
/// displacement that this causes (m). A row whose nodes are all held is skipped.
template <class Count>
double RowSweeps::relax(RowSystem::Row& row, const RowSystem::Ends& ends, Count count) {
  if (!(row.normalResponse > 0)) return 0;
  const Vec2 moved = system_.relativeMotion(row, ends, count, system_.moved);
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
  system_.push(row, ends, count, pushed * row.normal + pulled * row.along(), system_.moved);
  return std::max(std::abs(pushed) * row.normalResponse, slid);
}

}  // namespace yadefrag
