#include "contact/rigid_rows.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Map<const Vector3d> vectorOf(const std::array<double, 3>& motion) {
  return Map<const Vector3d>(motion.data());
}

}  // namespace

void RigidRows::index(const RowSystem& system) {
  rowsOf_.offsets.clear();
  if (system.turns.empty()) return;
  bodyOf_.assign(system.nodes.size(), RowSystem::kNone);
  shares_.assign(system.nodes.size(), 0);
  std::vector<std::uint32_t> rows;
  std::uint32_t bodies = 0;
  for (std::uint32_t r = 0; r < system.rows.size(); ++r) {
    if (system.rows[r].turn == RowSystem::kNone) continue;
    rows.push_back(r);
    std::uint32_t& body = bodyOf_[system.turns[system.rows[r].turn].number];
    if (body == RowSystem::kNone) body = bodies++;
  }
  const auto bodyOfRow = [&](std::size_t i) {
    return bodyOf_[system.turns[system.rows[rows[i]].turn].number];
  };
  fillRows(rowsOf_, bodies, rows.size(), bodyOfRow, [&](std::size_t i) { return rows[i]; });
}

/// gᵢ, aᵢ and Dᵢ of both forces of the body's rows.
void RigidRows::collect(const RowSystem& system, std::size_t body) {
  const auto others = [](const RowSystem::Row& row, auto visit) {
    for (std::uint32_t k = 0; k + 1 < row.count; ++k) visit(row.node[k], row.weight[k]);
  };
  for (const std::uint32_t r : rowsOf(body))
    others(system.rows[r], [&](std::uint32_t node, double) { shares_[node] = 0; });
  for (const std::uint32_t r : rowsOf(body))
    others(system.rows[r], [&](std::uint32_t node, double) { ++shares_[node]; });
  forces_.clear();
  for (const std::uint32_t r : rowsOf(body)) {
    const RowSystem::Row& row = system.rows[r];
    const RowSystem::Turn& turn = system.turns[row.turn];
    const Vec2 perForce = system.moved[turn.number].perForce;
    const double weight = row.weight[row.count - 1];
    const auto leverOf = [&](Vec2 along) -> Motion {
      return {weight * along.x * std::sqrt(perForce.x), weight * along.y * std::sqrt(perForce.y),
              cross(turn.lever, along) * std::sqrt(turn.perMoment)};
    };
    double normal = 0, tangent = 0, both = 0;
    others(row, [&](std::uint32_t node, double w) {
      const Vec2 mobile = w * w * shares_[node] * system.moved[node].perForce;
      normal += weighted(row.normal, mobile, row.normal);
      tangent += weighted(row.along(), mobile, row.along());
      both += std::abs(weighted(row.normal, mobile, row.along()));
    });
    const Vec2 moved = system.relativeMotion(row);
    const auto add = [&](Vec2 along, double compliance, double response, double gap, double force,
                         double most) {
      compliance = std::max(compliance, tolerance::kLeastShare * response);
      forces_.push_back({leverOf(along), compliance, gap, force, 0, most, 0});
    };
    add(row.normal, normal + both, row.normalResponse, row.gap + dot(moved, row.normal),
        row.normalForce, INFINITY);
    const bool slides = !(row.tangentResponse > 0);  // without friction
    add(row.along(), slides ? 1 : tangent + both, row.tangentResponse,
        row.slip + dot(moved, row.along()), row.tangentForce, 0);
  }
}

/// Sets the forces; returns the gradient of the function, p − Σ aᵢλᵢ − Σ bᵢτᵢ, and the sum of its
/// terms without their signs.
RigidRows::Residual RigidRows::residualAt(const Motion& motion) {
  Vector3d sum = vectorOf(motion);
  double scale = sum.lpNorm<1>();
  for (Force& force : forces_) {
    const auto lever = vectorOf(force.lever);
    const double gap = force.gap + lever.dot(vectorOf(motion));
    force.change =
        std::clamp(-gap / force.compliance, force.least - force.former, force.most - force.former);
    sum -= force.change * lever;
    scale += std::abs(force.change) * lever.lpNorm<1>();
  }
  return {{sum.x(), sum.y(), sum.z()}, scale};
}

/// Newton's method. Along its direction the slope grows: a step that leads too far past the minimum
/// is halved. (The function itself decides no better than the root of rounding.)
void RigidRows::minimize(Motion& motion) {
  Residual residual = residualAt(motion);
  for (int iteration = 0; iteration < tolerance::kMostNewton; ++iteration) {
    const Vector3d gradient = vectorOf(residual.value);
    if (!(gradient.lpNorm<1>() > tolerance::kNewtonResidual * residual.scale)) return;
    Matrix3d stiffness = Matrix3d::Identity();
    for (const Force& force : forces_) {
      const auto lever = vectorOf(force.lever);
      if (force.change > force.least - force.former && force.change < force.most - force.former)
        stiffness += (1 / force.compliance) * lever * lever.transpose();
    }
    const Vector3d direction = -stiffness.ldlt().solve(gradient);
    const double most = -.5 * direction.dot(gradient);
    const Motion start = motion;
    for (double length = 1;; length /= 2) {
      Map<Vector3d>(motion.data()) = vectorOf(start) + length * direction;
      residual = residualAt(motion);
      if (direction.dot(vectorOf(residual.value)) <= most) break;
      if (length < tolerance::kShortestSearch) return;  // rounding
    }
  }
}

double RigidRows::solve(RowSystem& system, std::size_t body) {
  collect(system, body);
  Motion motion = {};
  const std::span<const std::uint32_t> rows = rowsOf(body);
  // Friction follows the normal forces, which it changes in turn.
  for (int pass = 0; pass < tolerance::kFrictionPasses; ++pass) {
    double most = 0, changed = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Force& normal = forces_[2 * i];
      Force& tangent = forces_[2 * i + 1];
      const double bound = system.rows[rows[i]].friction * (normal.former + normal.change);
      changed = std::max(changed, std::abs(bound - tangent.most));
      most = std::max(most, bound);
      tangent.least = -bound, tangent.most = bound;
    }
    if (pass > 0 && !(changed > tolerance::kFrictionChange * most)) break;
    minimize(motion);
  }
  return apply(system, body, motion);
}

/// `motion`: the change of the body's.
double RigidRows::apply(RowSystem& system, std::size_t body, const Motion& motion) {
  const std::span<const std::uint32_t> rows = rowsOf(body);
  double most = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RowSystem::Row& row = system.rows[rows[i]];
    const Force &normal = forces_[2 * i], &tangent = forces_[2 * i + 1];
    if (normal.change == 0 && tangent.change == 0) continue;
    row.normalForce = normal.former + normal.change;
    row.tangentForce = tangent.former + tangent.change;
    system.push(row, normal.change * row.normal + tangent.change * row.along());
    for (const Force* force : {&normal, &tangent})
      if (force->change != 0)
        most = std::max({most, std::abs(vectorOf(force->lever).dot(vectorOf(motion))),
                         std::abs(force->change) * force->compliance});
  }
  return most;
}

}  // namespace yadefrag
