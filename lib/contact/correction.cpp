#include "contact/correction.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"
#include "mesh/mobility.hpp"

namespace yadefrag {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

double weighted(Vec2 a, Vec2 mobile, Vec2 b) { return a.x * mobile.x * b.x + a.y * mobile.y * b.y; }

/// (N) The largest force that undoes one row's gap or slip by itself.
double forceScale(const BoxProblem& problem) {
  double scale = 0;
  for (std::size_t i = 0; i < problem.size(); ++i)
    for (std::uint32_t k = problem.offsets[i]; k < problem.offsets[i + 1]; ++k)
      if (problem.columns[k] == i && problem.values[k] > 0)
        scale = std::max(scale, std::abs(problem.constant[i]) / problem.values[k]);
  return scale;
}

}  // namespace

double Lagrange::solve(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag) {
  findContactGroups(rows, nodes, groups_);
  normalOf_.resize(rows.size());
  tangentOf_.resize(rows.size());
  double residual = 0;
  for (std::size_t group = 0; group < groups_.rows.rows(); ++group) {
    const auto members = groups_.rows.row(group);
    numberUnknowns(rows, members);
    assemble(rows, nodes, group, dt, drag);
    residual = std::max(residual, solveGroup(rows, members));
  }
  return residual;
}

/// Normal forces first; tangential ones only where there is friction.
void Lagrange::numberUnknowns(std::span<const ContactRow> rows,
                              std::span<const std::uint32_t> members) {
  std::uint32_t count = 0;
  for (const std::uint32_t r : members) normalOf_[r] = count++;
  for (const std::uint32_t r : members) tangentOf_[r] = rows[r].friction > 0 ? count++ : kNone;
  problem_.constant.resize(count);
  problem_.lower.resize(count);
  problem_.upper.resize(count);
  start_.resize(count);
  for (const std::uint32_t r : members) {
    const std::uint32_t normal = normalOf_[r], tangent = tangentOf_[r];
    problem_.constant[normal] = rows[r].gap - rows[r].allowed;
    problem_.lower[normal] = 0;
    problem_.upper[normal] = kNoBound;
    start_[normal] = rows[r].normalForce;
    if (tangent == kNone) continue;
    problem_.constant[tangent] = rows[r].slip;
    start_[tangent] = rows[r].tangentForce;
  }
}

/// G = Δt² W M⁻¹ Wᵀ: two rows act on one another through every node that they share.
void Lagrange::assemble(std::span<const ContactRow> rows, const Nodes& nodes, std::size_t group,
                        double dt, double drag) {
  entries_.clear();
  const std::span<const RowNode> links(groups_.links);
  for (const std::uint32_t begin : groups_.spans.row(group)) {
    const NodeId node = links[begin].node;
    const Vec2 mobile = dt * dt * mobility(nodes, node, drag);
    std::size_t end = begin;
    while (end < links.size() && links[end].node == node) ++end;
    for (std::size_t p = begin; p < end; ++p)
      for (std::size_t q = begin; q < end; ++q)
        addPair(rows[links[p].row], rows[links[q].row], links[p], links[q], mobile);
  }
  problem_.setMatrix(problem_.constant.size(), entries_);
  mostForce_ = tolerance::kJam * forceScale(problem_);
}

void Lagrange::addPair(const ContactRow& a, const ContactRow& b, const RowNode& p, const RowNode& q,
                       Vec2 mobile) {
  const Vec2 scaled = p.weight * q.weight * mobile;
  const std::uint32_t na = normalOf_[p.row], nb = normalOf_[q.row];
  const std::uint32_t ta = tangentOf_[p.row], tb = tangentOf_[q.row];
  entries_.push_back({na, nb, weighted(a.normal, scaled, b.normal)});
  if (tb != kNone) entries_.push_back({na, tb, weighted(a.normal, scaled, b.tangent())});
  if (ta == kNone) return;
  entries_.push_back({ta, nb, weighted(a.tangent(), scaled, b.normal)});
  if (tb != kNone) entries_.push_back({ta, tb, weighted(a.tangent(), scaled, b.tangent())});
}

/// Without friction one solve. With it, the bounds of the tangential forces depend on the normal
/// ones: a sequence of solves with given bounds, which starts from the last step's forces and ends
/// where bounds and forces agree. Rejected: slip forces as −μ sgn(v)|F·e| in the matrix (eq. 8)
/// make it unsymmetric, and the sign has to be known beforehand.
double Lagrange::solveGroup(std::span<ContactRow> rows, std::span<const std::uint32_t> members) {
  const BoxResult* result = nullptr;
  boundFriction(rows, members, start_);
  for (int round = 0; round < tolerance::kFrictionRounds; ++round) {
    result = &solver_.solve(problem_, start_);
    if (problem_.size() == members.size() || !boundFriction(rows, members, result->lambda)) break;
    for (std::size_t i = 0; i < start_.size(); ++i)
      start_[i] = std::clamp(result->lambda[i], problem_.lower[i], problem_.upper[i]);
  }
  for (const std::uint32_t r : members) {
    rows[r].normalForce = result->lambda[normalOf_[r]];
    if (tangentOf_[r] == kNone) continue;
    const double most = rows[r].friction * rows[r].normalForce;
    rows[r].tangentForce = std::clamp(result->lambda[tangentOf_[r]], -most, most);
  }
  return result->residual;
}

/// Sets |τ| ≤ μλ; true if a bound has changed by more than the tolerance. Normal forces of bodies
/// that friction jams between each other grow from round to round: beyond any sense they bound no
/// more.
bool Lagrange::boundFriction(std::span<const ContactRow> rows,
                             std::span<const std::uint32_t> members,
                             std::span<const double> lambda) {
  double largest = 0, change = 0;
  for (const std::uint32_t r : members) {
    const std::uint32_t tangent = tangentOf_[r];
    if (tangent == kNone) continue;
    const double bound = rows[r].friction * std::min(lambda[normalOf_[r]], mostForce_);
    largest = std::max(largest, bound);
    change = std::max(change, std::abs(bound - problem_.upper[tangent]));
    problem_.lower[tangent] = -bound;
    problem_.upper[tangent] = bound;
  }
  return change > tolerance::kFrictionBound * largest;
}

void penalize(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag,
              double factor) {
  for (ContactRow& row : rows) {
    double normal = 0, tangent = 0;
    for (int k = 0; k < row.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Vec2 mobile =
          dt * dt * row.weight[at] * row.weight[at] * mobility(nodes, row.node[at], drag);
      normal += weighted(row.normal, mobile, row.normal);
      tangent += weighted(row.tangent(), mobile, row.tangent());
    }
    row.normalForce = normal > 0 ? factor * std::max(0., row.allowed - row.gap) / normal : 0;
    const double most = row.friction * row.normalForce;
    row.tangentForce = tangent > 0 ? std::clamp(-factor * row.slip / tangent, -most, most) : 0;
  }
}

}  // namespace yadefrag
