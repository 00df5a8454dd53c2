#include "contact/correction.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/contact.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag {

namespace {

/// True if a row penetrates, or pushes a slave farther out than necessary.
bool isOpen(const ContactRow& row, double tolerance) {
  return row.excess > tolerance || (row.excess < -tolerance && row.normalForce > 0);
}

/// Sweeps converge slowly where nodes on both sides of a light rigid body press on it.
bool isPivotedForRigid(std::span<const ContactRow> rows, std::span<const std::uint32_t> members) {
  const auto onBody = [&](std::uint32_t r) { return rows[r].rigid.mass != ContactRow::kNoMass; };
  return members.size() <= tolerance::kPivotedRigidRows && std::ranges::any_of(members, onBody);
}

/// (N) The largest force that removes the gap or slip of one row alone.
double forceScale(const BoxProblem& problem) {
  double scale = 0;
  for (std::size_t i = 0; i < problem.size(); ++i)
    for (std::uint32_t k = problem.offsets[i]; k < problem.offsets[i + 1]; ++k)
      if (problem.columns[k] == i && problem.values[k] > 0)
        scale = std::max(scale, std::abs(problem.constant[i]) / problem.values[k]);
  return scale;
}

}  // namespace

void Lagrange::setRows(std::span<const ContactRow> rows, const Inertia& inertia) {
  findContactGroups(rows, inertia.nodes, groups_);
  normalOf_.resize(rows.size());
  const auto rubs = [](const ContactRow& row) { return row.friction > 0; };
  tangentOf_.resize(std::ranges::any_of(rows, rubs) ? rows.size() : 0);
  const std::size_t groups = groups_.rows.rows();
  if (systems_.size() < groups) systems_.resize(groups);
  for (std::size_t group = 0; group < groups; ++group) assemble(rows, inertia, group);
}

Lagrange::Outcome Lagrange::solve(std::span<ContactRow> rows, const Inertia& inertia,
                                  double tolerance) {
  const RowSweeps::Stop stop{tolerance::kSweptChange * tolerance, tolerance::kGroupSweeps};
  Outcome worst;
  for (std::size_t group = 0; group < groups_.rows.rows(); ++group) {
    const Members members = groups_.rows.row(group);
    System& system = systems_[group];
    system.outcome.sweeps = 0;
    if (std::ranges::any_of(members, [&](std::uint32_t r) { return isOpen(rows[r], tolerance); })) {
      if (system.isSwept) {
        const double change = sweeps_.solve(rows, members, inertia, stop);
        system.outcome = {0, change, sweeps_.sweeps()};
      } else {
        solveGroup(rows, members, system);
      }
    }
    worst.residual = std::max(worst.residual, system.outcome.residual);
    worst.change = std::max(worst.change, system.outcome.change);
    worst.sweeps = std::max(worst.sweeps, system.outcome.sweeps);
  }
  return worst;
}

double Lagrange::sweep(std::span<ContactRow> rows, const Inertia& inertia, double change,
                       Coupling* coupling) {
  return sweeps_.solve(rows, inertia, {change, tolerance::contact().rowSweeps}, coupling);
}

/// True if a group is solved by sweeps. Without friction pivoting is as fast, and exact. With
/// friction, the bounds change with each solution.
bool Lagrange::isSwept(Members members) const {
  return members.size() > tolerance::kPivotedRows && !tangentOf_.empty();
}

/// Normal forces first; tangential forces only with friction. Returns the number of unknowns.
std::size_t Lagrange::numberUnknowns(std::span<const ContactRow> rows, Members members) {
  std::uint32_t count = 0;
  for (const std::uint32_t r : members) normalOf_[r] = count++;
  if (tangentOf_.empty()) return count;
  for (const std::uint32_t r : members) tangentOf_[r] = rows[r].friction > 0 ? count++ : kNone;
  return count;
}

/// G = Δt² W M⁻¹ Wᵀ: two rows interact through every common node and through a common rigid body.
void Lagrange::assemble(std::span<const ContactRow> rows, const Inertia& inertia,
                        std::size_t group) {
  System& system = systems_[group];
  const Members members = groups_.rows.row(group);
  system.outcome = {};
  system.isSwept = isSwept(members) && !isPivotedForRigid(rows, members);
  if (system.isSwept) return;
  const std::size_t unknowns = numberUnknowns(rows, members);
  entries_.clear();
  const std::span<const RowNode> links(groups_.links);
  for (const std::uint32_t begin : groups_.spans.row(group)) {
    const NodeId node = links[begin].node;
    const double squared = inertia.step.squared();
    const Vec2 mobile = squared * inertia.mobilityOf(node);
    const double turning = squared * inertia.turningOf(node);
    std::size_t end = begin;
    while (end < links.size() && links[end].node == node) ++end;
    for (std::size_t p = begin; p < end; ++p)
      for (std::size_t q = begin; q < end; ++q)
        addPair(rows[links[p].row], rows[links[q].row], links[p], links[q], mobile, turning);
  }
  system.problem.setMatrix(unknowns, entries_);
  setGaps(rows, members, system.problem);
  system.mostForce = tolerance::kJam * forceScale(system.problem);
}

void Lagrange::setGaps(std::span<const ContactRow> rows, Members members, BoxProblem& problem) {
  const std::size_t unknowns = problem.offsets.size() - 1;
  problem.constant.resize(unknowns);
  problem.lower.resize(unknowns);
  problem.upper.resize(unknowns);
  start_.resize(unknowns);
  for (const std::uint32_t r : members) {
    const std::uint32_t normal = normalOf_[r], tangent = tangentOf(r);
    problem.constant[normal] = rows[r].gap - rows[r].toleratedGap;
    problem.lower[normal] = 0;
    problem.upper[normal] = kNoBound;
    start_[normal] = rows[r].normalForce;
    if (tangent == kNone) continue;
    problem.constant[tangent] = rows[r].slip;
    start_[tangent] = rows[r].tangentForce;
  }
}

/// `mobile` (m/N), `turning` (rad/(N m)): displacement and rotation per force and moment.
void Lagrange::addPair(const ContactRow& a, const ContactRow& b, const RowNode& p, const RowNode& q,
                       Vec2 mobile, double turning) {
  const Vec2 scaled = p.weight * q.weight * mobile;
  const auto coupling = [&](Vec2 e, Vec2 f) {
    const double moved = weighted(e, scaled, f);
    return turning == 0 ? moved : moved + turning * cross(p.lever, e) * cross(q.lever, f);
  };
  const std::uint32_t na = normalOf_[p.row], nb = normalOf_[q.row];
  const std::uint32_t ta = tangentOf(p.row), tb = tangentOf(q.row);
  entries_.push_back({na, nb, coupling(a.normal, b.normal)});
  if (tb != kNone) entries_.push_back({na, tb, coupling(a.normal, b.tangent())});
  if (ta == kNone) return;
  entries_.push_back({ta, nb, coupling(a.tangent(), b.normal)});
  if (tb != kNone) entries_.push_back({ta, tb, coupling(a.tangent(), b.tangent())});
}

/// Without friction one solution. With friction, the bounds of the tangential forces depend on the
/// normal ones: a sequence of solutions with given bounds, which starts from the last step's forces
/// and ends when bounds and forces are consistent. Rejected: slip forces as −μ sgn(v)|F·e| in the
/// matrix (eq. 8) make it unsymmetric, and the sign must be known in advance.
void Lagrange::solveGroup(std::span<ContactRow> rows, Members members, System& system) {
  BoxProblem& problem = system.problem;
  setGaps(rows, members, problem);
  boundFriction(rows, members, system, start_);
  const BoxResult* result = nullptr;
  for (int round = 0; round < tolerance::kFrictionRounds; ++round) {
    result = &solver_.solve(problem, start_);
    if (problem.size() == members.size() || !boundFriction(rows, members, system, result->lambda))
      break;
    for (std::size_t i = 0; i < start_.size(); ++i)
      start_[i] = std::clamp(result->lambda[i], problem.lower[i], problem.upper[i]);
  }
  for (const std::uint32_t r : members) {
    rows[r].excess = 0;
    rows[r].normalForce = result->lambda[normalOf_[r]];
    if (tangentOf(r) == kNone) continue;
    const double most = rows[r].friction * rows[r].normalForce;
    rows[r].tangentForce = std::clamp(result->lambda[tangentOf(r)], -most, most);
  }
  system.outcome = {result->residual, 0, 0};
}

/// Sets |τ| ≤ μλ; returns true if a bound has changed by more than the tolerance. Normal forces of
/// bodies that are jammed by friction grow from round to round; above `mostForce` they do not
/// increase bounds any more.
bool Lagrange::boundFriction(std::span<const ContactRow> rows, Members members, System& system,
                             std::span<const double> lambda) const {
  if (tangentOf_.empty()) return false;
  BoxProblem& problem = system.problem;
  double largest = 0, change = 0;
  for (const std::uint32_t r : members) {
    const std::uint32_t tangent = tangentOf(r);
    if (tangent == kNone) continue;
    const double bound = rows[r].friction * std::min(lambda[normalOf_[r]], system.mostForce);
    largest = std::max(largest, bound);
    change = std::max(change, std::abs(bound - problem.upper[tangent]));
    problem.lower[tangent] = -bound;
    problem.upper[tangent] = bound;
  }
  return change > tolerance::kFrictionBound * largest;
}

void Lagrange::addTo(Footprint& footprint) const {
  footprint.add(Use::kContact, groups_.links, groups_.rows.values, groups_.rows.offsets,
                groups_.spans.values, groups_.spans.offsets, systems_, entries_, normalOf_, start_);
  footprint.add(Use::kFriction, tangentOf_);
  // Sweeps are used for large groups with friction, and for rubble.
  sweeps_.addTo(footprint, tangentOf_.empty() ? Use::kFracture : Use::kFriction);
  for (const System& system : systems_) {
    const BoxProblem& p = system.problem;
    footprint.add(Use::kContact, p.offsets, p.columns, p.values, p.constant, p.lower, p.upper);
  }
}

}  // namespace yadefrag
