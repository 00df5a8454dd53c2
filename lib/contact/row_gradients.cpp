// RowSweeps: conjugate gradients on the forces within their bounds. They minimise ½λᵀGλ + gᵀλ, with
// the responses of single rows as a preconditioner, up to the first bound that a force reaches:
// which forces are at a bound is decided by the sweeps.

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/row_sweeps.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag {

/// Once, before threads share the work.
void RowSweeps::makeRoomForGradients() {
  const std::size_t count = rows_.size();
  former_.resize(count), residual_.resize(count), perResidual_.resize(count);
  direction_.resize(count), response_.resize(count);
  along_ = moved_;
}

void RowSweeps::descendIfDue(const Group& group, double tolerance) {
  Attempts& attempts = attempts_[order_[group.begin]];
  const int sweeps = attempts.former + group.sweeps;
  if (sweeps < attempts.next) return;
  if (!(findResiduals(group) > tolerance))
    attempts.between = tolerance::kSweepsToDescend;
  else if (descend(group, tolerance))
    attempts.between = tolerance::kSweepsAfterDescent;
  else
    attempts.between =
        std::max(tolerance::kMoreSweeps * attempts.between, tolerance::kSweepsToDescend);
  attempts.next = sweeps + attempts.between;
}

/// From the residuals found, until none exceeds `tolerance` (m); returns false if a force reaches a
/// bound before.
bool RowSweeps::descend(const Group& group, double tolerance) {
  double worst = INFINITY;
  double square = scaledSquare(group), kept = 0;
  bool isBounded = false;
  for (int i = 0; i < tolerance::kDescents && worst > tolerance && !isBounded; ++i) {
    turnDirection(group, kept);
    const double curvature = findResponses(group);
    if (!(curvature > 0)) break;
    const double step = square / curvature, bound = stepToBound(group);
    isBounded = bound < step;
    worst = advance(group, std::min(bound, step));
    const double former = std::exchange(square, scaledSquare(group));
    kept = square / former;
  }
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
    const SweepRow& row = rows_[r];
    const Vec2 change = (row.normalForce - former_[r].normal) * row.normal +
                        (row.tangentForce - former_[r].tangent) * row.along();
    push(row, ends_[r], change, moved_);
    waiting_.add(group.waitingOf(r));
  }
  return !isBounded;
}

/// Returns the largest one (m).
double RowSweeps::findResiduals(const Group& group) {
  double worst = 0;
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
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
void RowSweeps::turnDirection(const Group& group, double kept) {
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
    Pair& d = direction_[r];
    d.normal = perResidual_[r].normal * residual_[r].normal + kept * d.normal;
    d.tangent = perResidual_[r].tangent * residual_[r].tangent + kept * d.tangent;
  }
}

/// Each row has a small compliance: where rows contradict each other, a direction would have no
/// response at all. Returns the quadratic's second derivative in the direction (N m).
double RowSweeps::findResponses(const Group& group) {
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
    const Ends& ends = ends_[r];
    for (std::uint32_t k = 0; k < ends.count; ++k) along_.nodes[ends.node[k]].shift = {};
    if (ends.turn != kNone) along_.turns[turns_[ends.turn].number] = 0;
  }
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
    const SweepRow& row = rows_[r];
    push(row, ends_[r], direction_[r].normal * row.normal + direction_[r].tangent * row.along(),
         along_);
  }
  double curvature = 0;
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
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
double RowSweeps::scaledSquare(const Group& group) const {
  double sum = 0;
  for (std::uint32_t r = group.begin; r < group.end; ++r)
    sum += perResidual_[r].normal * residual_[r].normal * residual_[r].normal +
           perResidual_[r].tangent * residual_[r].tangent * residual_[r].tangent;
  return sum;
}

/// Multiple of the direction at which the first force reaches a bound.
double RowSweeps::stepToBound(const Group& group) const {
  double step = INFINITY;
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
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
double RowSweeps::advance(const Group& group, double step) {
  double worst = 0;
  for (std::uint32_t r = group.begin; r < group.end; ++r) {
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
