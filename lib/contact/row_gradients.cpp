#include "contact/row_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/tolerances/solver.hpp"

namespace yadefrag {

void RowGradients::makeRoom(const RowSystem& system) {
  const std::size_t count = system.rows.size();
  former_.resize(count), residual_.resize(count), perResidual_.resize(count);
  direction_.resize(count), response_.resize(count);
  along_ = system.moved;
}

bool RowGradients::descend(RowSystem& system, RowRange range, double tolerance) {
  assert(range.end <= residual_.size());
  double worst = INFINITY;
  double square = scaledSquare(range), kept = 0;
  bool isBounded = false;
  for (int i = 0; i < tolerance::kDescents && worst > tolerance && !isBounded; ++i) {
    turnDirection(range, kept);
    const Curvature curvature = findResponses(system, range);
    if (!(curvature.together > tolerance::kContrary * curvature.alone)) break;
    const double step = square / curvature.together, bound = stepToBound(system, range);
    isBounded = bound < step;
    worst = advance(system, range, std::min(bound, step));
    const double former = std::exchange(square, scaledSquare(range));
    kept = square / former;
  }
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Row& row = system.rows[r];
    const Vec2 change = (row.normalForce - former_[r].normal) * row.normal +
                        (row.tangentForce - former_[r].tangent) * row.along();
    system.push(row, system.ends[r], change, system.moved);
  }
  return !isBounded;
}

double RowGradients::findResiduals(const RowSystem& system, RowRange range) {
  double worst = 0;
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Row& row = system.rows[r];
    residual_[r] = perResidual_[r] = direction_[r] = {};
    former_[r] = {row.normalForce, row.tangentForce};
    if (!(row.normalForce > 0 && row.normalResponse > 0)) continue;
    const Vec2 moved =
        system.relativeMotion(row, system.ends[r], system.ends[r].count, system.moved);
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
void RowGradients::turnDirection(RowRange range, double kept) {
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    Pair& d = direction_[r];
    d.normal = perResidual_[r].normal * residual_[r].normal + kept * d.normal;
    d.tangent = perResidual_[r].tangent * residual_[r].tangent + kept * d.tangent;
  }
}

RowGradients::Curvature RowGradients::findResponses(const RowSystem& system, RowRange range) {
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Ends& ends = system.ends[r];
    for (std::uint32_t k = 0; k < ends.count; ++k) along_.nodes[ends.node[k]].shift = {};
    if (ends.turn != RowSystem::kNone) along_.turns[system.turns[ends.turn].number] = 0;
  }
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Row& row = system.rows[r];
    system.push(row, system.ends[r],
                direction_[r].normal * row.normal + direction_[r].tangent * row.along(), along_);
  }
  Curvature curvature;
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Row& row = system.rows[r];
    const Pair& d = direction_[r];
    const Vec2 moved = system.relativeMotion(row, system.ends[r], system.ends[r].count, along_);
    response_[r] = {dot(moved, row.normal), dot(moved, row.along())};
    curvature.together += d.normal * response_[r].normal + d.tangent * response_[r].tangent;
    curvature.alone +=
        d.normal * row.normalResponse * d.normal + d.tangent * row.tangentResponse * d.tangent;
  }
  return curvature;
}

/// (N m) Σ residual² per response of the row alone.
double RowGradients::scaledSquare(RowRange range) const {
  double sum = 0;
  for (std::uint32_t r = range.begin; r < range.end; ++r)
    sum += perResidual_[r].normal * residual_[r].normal * residual_[r].normal +
           perResidual_[r].tangent * residual_[r].tangent * residual_[r].tangent;
  return sum;
}

/// Multiple of the direction at which the first force reaches a bound.
double RowGradients::stepToBound(const RowSystem& system, RowRange range) const {
  double step = INFINITY;
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    const RowSystem::Row& row = system.rows[r];
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
double RowGradients::advance(RowSystem& system, RowRange range, double step) {
  double worst = 0;
  for (std::uint32_t r = range.begin; r < range.end; ++r) {
    if (perResidual_[r].normal == 0) continue;
    RowSystem::Row& row = system.rows[r];
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
