// RowSweeps: conjugate gradients on the forces within their bounds. They minimise ½λᵀGλ + gᵀλ, with
// the responses of single rows as a preconditioner, up to the first bound that a force reaches:
// which forces are at a bound is decided by the sweeps.

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/row_sweeps.hpp"
#include "core/disjoint_sets.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag {

void RowSweeps::findGroups() {
  DisjointSets sets(rows_.size());
  std::vector<std::uint32_t> rowOfNode(nodes_.size(), kNone);
  for (std::uint32_t r = 0; r < rows_.size(); ++r)
    for (std::uint32_t k = 0; k < ends_[r].count; ++k) {
      if (moved_.nodes[ends_[r].node[k]].perForce == Vec2{})
        continue;  // A held node transmits no force.
      std::uint32_t& first = rowOfNode[ends_[r].node[k]];
      if (first == kNone)
        first = r;
      else
        sets.join(first, r);
    }
  std::vector<std::uint32_t> groupOfRow;
  const std::uint32_t count = sets.number(groupOfRow);
  fillRows(
      groups_, count, rows_.size(), [&](std::size_t r) { return groupOfRow[r]; },
      [](std::size_t r) { return static_cast<std::uint32_t>(r); });
}

/// In the groups whose turn it is.
void RowSweeps::descend(double tolerance) {
  if (groups_.rows() == 0) findGroups(), along_ = moved_;
  schedules_.resize(rows_.size());
  former_.resize(rows_.size()), residual_.resize(rows_.size()), perResidual_.resize(rows_.size());
  direction_.resize(rows_.size()), response_.resize(rows_.size());
  for (std::size_t g = 0; g < groups_.rows(); ++g) {
    const Members members = groups_.row(g);
    auto& [wait, next] = schedules_[members.front()];
    if (total_ < next) continue;
    if (!(findResiduals(members) > tolerance)) {
      next = total_ + tolerance::kSweepsToDescend;
      continue;
    }
    wait = descend(members, tolerance)
               ? tolerance::kSweepsAfterDescent
               : std::max(tolerance::kMoreSweeps * wait, tolerance::kSweepsToDescend);
    next = total_ + wait;
  }
}

/// From the residuals found, until none exceeds `tolerance` (m); returns false if a bound ends them
/// before.
bool RowSweeps::descend(Members members, double tolerance) {
  double square = scaledSquare(members), kept = 0, worst = INFINITY;
  bool isBounded = false;
  for (int i = 0; i < tolerance::kDescents && worst > tolerance && !isBounded; ++i) {
    turnDirection(members, kept);
    const double curvature = findResponses(members);
    if (!(curvature > 0)) break;
    const double step = square / curvature, bound = stepToBound(members);
    isBounded = bound < step;
    worst = advance(members, std::min(bound, step));
    const double former = std::exchange(square, scaledSquare(members));
    kept = square / former;
  }
  for (const std::uint32_t r : members) {
    const SweepRow& row = rows_[r];
    const Vec2 change = (row.normalForce - former_[r].normal) * row.normal +
                        (row.tangentForce - former_[r].tangent) * row.along();
    push(row, ends_[r], ends_[r].count, change, moved_);
    waiting_.add(r);
  }
  return !isBounded;
}

/// Returns the largest one (m).
double RowSweeps::findResiduals(Members members) {
  double worst = 0;
  for (const std::uint32_t r : members) {
    const SweepRow& row = rows_[r];
    residual_[r] = perResidual_[r] = direction_[r] = {};
    former_[r] = {row.normalForce, row.tangentForce};
    if (!(row.normalForce > 0 && row.normalResponse > 0)) continue;
    const Vec2 moved = relativeMotion(row, ends_[r], ends_[r].count, moved_);
    residual_[r].normal = -(row.gap + dot(moved, row.normal));
    perResidual_[r].normal = 1 / row.normalResponse;
    worst = std::max(worst, std::abs(residual_[r].normal));
    if (!(row.tangentResponse > 0 && std::abs(row.tangentForce) < row.friction * row.normalForce))
      continue;
    residual_[r].tangent = -(row.slip + dot(moved, row.along()));
    perResidual_[r].tangent = 1 / row.tangentResponse;
    worst = std::max(worst, std::abs(residual_[r].tangent));
  }
  return worst;
}

/// `kept`: part of the former direction in the new one.
void RowSweeps::turnDirection(Members members, double kept) {
  for (const std::uint32_t r : members) {
    Pair& d = direction_[r];
    d.normal = perResidual_[r].normal * residual_[r].normal + kept * d.normal;
    d.tangent = perResidual_[r].tangent * residual_[r].tangent + kept * d.tangent;
  }
}

/// Each row has a small compliance: where rows contradict each other, a direction would have no
/// response at all. Returns the quadratic's second derivative in the direction (N m).
double RowSweeps::findResponses(Members members) {
  for (const std::uint32_t r : members) {
    const Ends& ends = ends_[r];
    for (std::uint32_t k = 0; k < ends.count; ++k) along_.nodes[ends.node[k]].shift = {};
    if (ends.turn != kNone) along_.turns[turns_[ends.turn].number] = 0;
  }
  for (const std::uint32_t r : members) {
    const SweepRow& row = rows_[r];
    push(row, ends_[r], ends_[r].count,
         direction_[r].normal * row.normal + direction_[r].tangent * row.along(), along_);
  }
  double curvature = 0;
  for (const std::uint32_t r : members) {
    const SweepRow& row = rows_[r];
    const Vec2 moved = relativeMotion(row, ends_[r], ends_[r].count, along_);
    response_[r] = {
        dot(moved, row.normal) + tolerance::kCompliance * row.normalResponse * direction_[r].normal,
        dot(moved, row.along()) +
            tolerance::kCompliance * row.tangentResponse * direction_[r].tangent};
    curvature +=
        direction_[r].normal * response_[r].normal + direction_[r].tangent * response_[r].tangent;
  }
  return curvature;
}

/// (N m) Σ residual² per response of the row alone.
double RowSweeps::scaledSquare(Members members) const {
  double sum = 0;
  for (const std::uint32_t r : members)
    sum += perResidual_[r].normal * residual_[r].normal * residual_[r].normal +
           perResidual_[r].tangent * residual_[r].tangent * residual_[r].tangent;
  return sum;
}

/// Multiple of the direction at which the first force reaches a bound.
double RowSweeps::stepToBound(Members members) const {
  double step = INFINITY;
  for (const std::uint32_t r : members) {
    const SweepRow& row = rows_[r];
    const Pair& d = direction_[r];
    if (d.normal < 0) step = std::min(step, -row.normalForce / d.normal);
    if (perResidual_[r].tangent == 0) continue;
    const double bound = row.friction * row.normalForce, more = row.friction * d.normal;
    if (d.tangent > more) step = std::min(step, (bound - row.tangentForce) / (d.tangent - more));
    if (-d.tangent > more) step = std::min(step, (bound + row.tangentForce) / (-d.tangent - more));
  }
  return step;
}

/// Returns the largest residual (m) then.
double RowSweeps::advance(Members members, double step) {
  double worst = 0;
  for (const std::uint32_t r : members) {
    if (perResidual_[r].normal == 0) continue;
    SweepRow& row = rows_[r];
    row.normalForce = std::max(0., row.normalForce + step * direction_[r].normal);
    residual_[r].normal -= step * response_[r].normal;
    worst = std::max(worst, std::abs(residual_[r].normal));
    // A force that slips has no direction, but its bound has changed.
    const double most = row.friction * row.normalForce;
    row.tangentForce = std::clamp(row.tangentForce + step * direction_[r].tangent, -most, most);
    residual_[r].tangent -= step * response_[r].tangent;
    worst = std::max(worst, std::abs(residual_[r].tangent));
  }
  return worst;
}

}  // namespace yadefrag
