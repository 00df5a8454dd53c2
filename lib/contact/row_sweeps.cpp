#include "contact/row_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/contact.hpp"

namespace yadefrag {

double RowSweeps::begin(Stop stop, CoupledForces* coupled, std::vector<Vec2>* position) {
  system_.pushAll();
  rigid_.index(system_);
  lastMoved_.assign(system_.nodes.size(), 0);
  share(coupled, position);
  const bool isCoupled = !shared_.empty();
  const int most = std::max(stop.most, tolerance::kMostSweeps);
  double change = INFINITY;
  change_ = stop.change;
  for (count_ = 0; change > change_;) {
    const bool isFar = change > tolerance::kFarFromSolved * change_;
    if (count_ >= (isFar ? most : stop.most)) break;
    change = sweep(count_);
    if (count_ == 0) change_ = std::clamp(tolerance::kOfFirst * change, stop.least, stop.change);
    if (isCoupled && (count_ % tolerance::kSweepsToCouple == 0 || !(change > change_)))
      change = std::max(change, sweepCoupled(*coupled, *position, count_, false));
    ++count_;
  }
  return change;
}

/// Makes the row due if its gap has changed.
void RowSweeps::setGap(std::size_t number, double gap) {
  RowSystem::Row& row = system_.rows[number];
  if (std::abs(gap - row.gap) > tolerance::kMakesDue * change_)
    forNodes(row, [&](std::uint32_t node, double) { lastMoved_[node] = count_; });
  row.gap = gap;
}

void RowSweeps::improve(int most) {
  for (const int end = count_ + most; count_ < end; ++count_)
    if (!(sweep(count_) > change_)) break;
}

double RowSweeps::end(CoupledForces* coupled, std::vector<Vec2>* position) {
  return shared_.empty() ? 0 : sweepCoupled(*coupled, *position, count_, true);
}

/// Alternating directions: forces are transmitted along chains of rows.
double RowSweeps::sweep(int number) {
  const std::size_t count = system_.rows.size();
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    RowSystem::Row& row = system_.rows[number % 2 == 0 ? i : count - 1 - i];
    if (row.turn != RowSystem::kNone || !isDue(row, number)) continue;
    most = std::max(most, row.cross != 0 ? relaxNotch(row, number) : relax(row, number));
  }
  for (std::size_t body = 0; body < rigid_.bodies(); ++body)
    most = std::max(most, solveRigid(body, number));
  return most;
}

/// The rows of one rigid body.
double RowSweeps::solveRigid(std::size_t body, int sweep) {
  const auto rows = rigid_.rowsOf(body);
  if (std::ranges::none_of(rows, [&](auto r) { return isDue(system_.rows[r], sweep); })) return 0;
  const double most = rigid_.solve(system_, body);
  if (!(most > tolerance::kMakesDue * change_)) return most;
  for (const std::uint32_t r : rows)
    forNodes(system_.rows[r], [&](std::uint32_t node, double) { lastMoved_[node] = sweep; });
  return most;
}

/// From the third sweep on only rows of which a node has moved in this or in the last sweep.
bool RowSweeps::isDue(const RowSystem::Row& row, int sweep) const {
  if (!(row.normalResponse > 0)) return false;  // no node can move
  int last = sweep < 2 ? sweep : 0;
  forNodes(row, [&](std::uint32_t node, double) { last = std::max(last, lastMoved_[node]); });
  return last >= sweep - 1;
}

/// Sets one row's forces so that its own gap and slip vanish, within the bounds; returns the
/// displacement that this causes (m).
double RowSweeps::relax(RowSystem::Row& row, int sweep) {
  const Vec2 moved = system_.relativeMotion(row);
  const double gap = row.gap + dot(moved, row.normal);
  const double normal = std::max(0., row.normalForce - gap / row.normalResponse);
  return setForces(row, normal, moved, sweep);
}

/// Relaxes both rows of a notch: each alone, or both, whichever closes no gap.
double RowSweeps::relaxNotch(RowSystem::Row& row, int sweep) {
  RowSystem::Row& twin = (&row)[1];
  const Vec2 moved = system_.relativeMotion(row), twinMoved = system_.relativeMotion(twin);
  // Gaps without both forces.
  const double a = row.gap + dot(moved, row.normal) - row.normalResponse * row.normalForce -
                   row.cross * twin.normalForce;
  const double b = twin.gap + dot(twinMoved, twin.normal) - row.cross * row.normalForce -
                   twin.normalResponse * twin.normalForce;
  double first = std::max(0., -a / row.normalResponse), second = 0;
  if (b + row.cross * first < 0 && twin.normalResponse > 0) {
    second = std::max(0., -b / twin.normalResponse), first = 0;
    if (a + row.cross * second < 0) {
      const double product = row.normalResponse * twin.normalResponse;
      const double determinant = product - row.cross * row.cross;
      if (determinant > tolerance::kSameRows * product) {
        first = std::max(0., (b * row.cross - a * twin.normalResponse) / determinant);
        second = std::max(0., (a * row.cross - b * row.normalResponse) / determinant);
      }
    }
  }
  const double most = setForces(row, first, moved, sweep);
  return std::max(most, setForces(twin, second, system_.relativeMotion(twin), sweep));
}

/// `moved` (m): the row's relative motion so far.
double RowSweeps::setForces(RowSystem::Row& row, double normal, Vec2 moved, int sweep) {
  const double pushed = normal - row.normalForce;
  row.normalForce = normal;
  double pulled = 0;
  if (row.tangentResponse > 0) {  // only with friction
    const double slip = row.slip + dot(moved, row.along()) + pushed * row.slipPerNormal;
    const double bound = row.friction * normal;
    const double tangent = std::clamp(row.tangentForce - slip / row.tangentResponse, -bound, bound);
    pulled = tangent - row.tangentForce;
    row.tangentForce = tangent;
  }
  if (pushed == 0 && pulled == 0) return 0;
  system_.push(row, pushed * row.normal + pulled * row.along());
  const double most =
      std::max(std::abs(pushed) * row.normalResponse, std::abs(pulled) * row.tangentResponse);
  if (most > tolerance::kMakesDue * change_)
    forNodes(row, [&](std::uint32_t node, double) { lastMoved_[node] = sweep; });
  return most;
}

/// Finds the nodes of rows that coupled forces move, too.
void RowSweeps::share(CoupledForces* coupled, const std::vector<Vec2>* position) {
  shared_.clear();
  if (coupled == nullptr) return;
  for (std::uint32_t i = 0; i < system_.nodes.size(); ++i)
    if (system_.nodes[i].value < position->size() &&
        coupled->groupOf(system_.nodes[i]) != CoupledForces::kNoGroup)
      shared_.push_back({i, system_.nodes[i]});
  if (!shared_.empty()) coupled->begin(*position);
}

/// One sweep of the coupled forces, at the positions with the present contact forces; in the `last`
/// one they converge. Returns the largest displacement (m).
double RowSweeps::sweepCoupled(CoupledForces& forces, std::vector<Vec2>& position, int sweep,
                               bool last) {
  for (SharedNode& one : shared_) {
    const Vec2 byContact = system_.moved[one.number].shift - one.byOthers;
    if (norm(byContact - one.byContact) > (last ? 0 : change_) || !one.isKnown)
      forces.noteMoved(one.node);
    one.byContact = byContact, one.isKnown = true;
    Vec2& at = position[one.node.value];
    at += byContact;
    one.at = at;
  }
  const double most = last ? forces.converge(position) : forces.sweep(position, change_);
  for (SharedNode& one : shared_) {
    Vec2& at = position[one.node.value];
    const Vec2 moved = at - one.at;
    at = at - one.byContact;
    one.byOthers += moved;
    system_.moved[one.number].shift += moved;
    if (norm(moved) > tolerance::kMakesDue * change_) lastMoved_[one.number] = sweep;
  }
  return most;
}

}  // namespace yadefrag
