#include "contact/box_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "contact/box_pivoting.hpp"
#include "contact/box_small.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag {

void BoxProblem::setMatrix(std::size_t size, std::span<const MatrixEntry> entries) {
  // Transposing twice sorts by column, then by row.
  std::vector<std::uint32_t> order(entries.size());
  std::vector<std::uint32_t> begin(size + 1, 0);
  for (const MatrixEntry& e : entries) ++begin[e.column + 1];
  for (std::size_t i = 0; i < size; ++i) begin[i + 1] += begin[i];
  for (std::uint32_t k = 0; k < entries.size(); ++k) order[begin[entries[k].column]++] = k;

  offsets.assign(size + 1, 0);
  for (const MatrixEntry& e : entries) ++offsets[e.row + 1];
  for (std::size_t i = 0; i < size; ++i) offsets[i + 1] += offsets[i];
  std::vector<std::uint32_t> cursor(offsets.begin(), offsets.end());
  columns.resize(entries.size());
  values.resize(entries.size());
  for (const std::uint32_t k : order) {
    const std::uint32_t place = cursor[entries[k].row]++;
    columns[place] = entries[k].column;
    values[place] = entries[k].value;
  }

  std::uint32_t kept = 0;
  for (std::size_t row = 0; row < size; ++row) {
    const std::uint32_t first = kept;
    const std::uint32_t end = offsets[row + 1];
    for (std::uint32_t k = row == 0 ? 0 : cursor[row - 1]; k < end; ++k) {
      if (kept > first && columns[kept - 1] == columns[k]) {
        values[kept - 1] += values[k];
      } else {
        columns[kept] = columns[k];
        values[kept++] = values[k];
      }
    }
    offsets[row] = first;
  }
  offsets[size] = kept;
  columns.resize(kept);
  values.resize(kept);
}

struct BoxSolver::Work {
  ScaledBox box;
  std::vector<double> values;  ///< values of the scaled matrix
  std::vector<double> root;    ///< √Gᵢᵢ; 0: the row is excluded
  std::vector<double> lambda, centre, best;
  BoxPivoting pivoting;
  double largest = 0;  ///< m, max |g|
  double bestError = 0;
  int pivots = 0;
  int refinements = 0;

  void scale(const BoxProblem& problem);
  void startAt(const BoxProblem& problem, std::span<const double> start);
  double errorOf(bool& enough);
  bool check();
  bool iterate(double added, bool isGuess);
  bool sweep(int sweeps);
  bool fallBack();
};

BoxSolver::BoxSolver() : work_(std::make_unique<Work>()) {}
BoxSolver::~BoxSolver() = default;
BoxSolver::BoxSolver(BoxSolver&&) noexcept = default;
BoxSolver& BoxSolver::operator=(BoxSolver&&) noexcept = default;

void BoxSolver::Work::scale(const BoxProblem& p) {
  const std::size_t n = p.size();
  root.assign(n, 0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k)
      if (p.columns[k] == i && p.values[k] > 0) root[i] = std::sqrt(p.values[k]);
  values.resize(p.values.size());
  box.constant.resize(n), box.lower.resize(n), box.upper.resize(n), box.slack.resize(n);
  largest = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double factor = root[i] > 0 ? 1 / root[i] : 0;
    for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k) {
      const double other = root[p.columns[k]];
      values[k] = p.columns[k] == i ? double(factor > 0)
                  : other > 0       ? p.values[k] * factor / other
                                    : 0;
    }
    box.constant[i] = factor > 0 ? p.constant[i] * factor : 0;
    box.lower[i] = factor > 0 ? p.lower[i] * root[i] : 0;
    box.upper[i] = factor > 0 ? p.upper[i] * root[i] : 0;
    if (factor > 0) largest = std::max(largest, std::abs(p.constant[i]));
  }
  box.matrix = {std::span(p.offsets).first(n + 1), p.columns, values};
}

void BoxSolver::Work::startAt(const BoxProblem& p, std::span<const double> start) {
  const std::size_t n = p.size();
  best.resize(n);
  double push = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double guess = start.empty() || !std::isfinite(start[i]) ? 0 : start[i] * root[i];
    best[i] = std::clamp(guess, box.lower[i], box.upper[i]);
    push = std::max(push, std::abs(std::clamp(0., box.lower[i], box.upper[i])) * root[i]);
  }
  largest = std::max(largest, push);  // bounds that exclude zero cause forces even without g
  for (std::size_t i = 0; i < n; ++i)
    box.slack[i] = root[i] > 0 ? tolerance::kPivotSlack * largest / root[i] : 0;
  bestError = kNoBound;
  lambda = best;
  pivots = refinements = 0;
}

/// The true error of `lambda`, which is clamped into the box. `enough`: the error is within the
/// tolerance or rounding.
double BoxSolver::Work::errorOf(bool& enough) {
  double error = 0;
  enough = true;
  for (std::size_t i = 0; i < lambda.size(); ++i)
    lambda[i] = std::clamp(lambda[i], box.lower[i], box.upper[i]);
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    double r = box.constant[i];
    double sum = std::abs(r);
    for (std::uint32_t k = box.matrix.offsets[i]; k < box.matrix.offsets[i + 1]; ++k) {
      const double part = values[k] * lambda[box.matrix.columns[k]];
      r += part;
      sum += std::abs(part);
    }
    const double rowError =
        std::abs(lambda[i] - std::clamp(lambda[i] - r, box.lower[i], box.upper[i])) * root[i];
    enough = enough && rowError <= tolerance::kBoxResidual * largest +
                                       tolerance::kGapRounding * sum * root[i];
    if (!(rowError <= error)) error = rowError;  // NaN is kept
  }
  return error;
}

/// Stores `lambda` if it is the best so far; returns true if it is accurate enough.
bool BoxSolver::Work::check() {
  bool enough;
  const double error = errorOf(enough);
  if (!(error < bestError)) return false;
  bestError = error, best = lambda;
  return enough;
}

/// Proximal iterations with one ε; returns false if pivoting cycles or if they do not converge.
bool BoxSolver::Work::iterate(double added, bool isGuess) {
  lambda = best;
  pivoting.begin(box, lambda, isGuess);
  double compared = kNoBound;
  for (int i = 0; i < tolerance::kMostRefinements; ++i) {
    centre = lambda;
    const bool solved = pivoting.solve(box, added, centre, lambda);
    if (!solved) break;
    refinements += i > 0;
    if (check()) {
      pivots += pivoting.pivots();
      return true;
    }
    if ((i + 1) % tolerance::kRefinementsToHalve == 0) {
      if (bestError > .5 * compared) break;
      compared = bestError;
    }
  }
  pivots += pivoting.pivots();
  return false;
}

/// Projected Gauss–Seidel sweeps on the original problem.
bool BoxSolver::Work::sweep(int sweeps) {
  for (int s = 0; s < sweeps; ++s) {
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      if (root[i] == 0) continue;
      const double r = box.matrix.rowTimes(i, lambda.data()) + box.constant[i];
      lambda[i] = std::clamp(lambda[i] - r, box.lower[i], box.upper[i]);
    }
    if (s % tolerance::kSweepsToCheck == 0 && check()) return true;
  }
  return false;
}

/// Used if nothing converges: there may be no solution, and λ has grown without bound. A few steps
/// with a large ε satisfy the rows that can be satisfied, and bound the forces of the others.
/// Returns true if the error is small enough nevertheless.
bool BoxSolver::Work::fallBack() {
  const double firmError = bestError;
  const std::vector<double> firm = best;
  bestError = kNoBound;
  for (std::size_t i = 0; i < lambda.size(); ++i)
    best[i] = lambda[i] = std::clamp(0., box.lower[i], box.upper[i]);
  pivoting.begin(box, lambda, false);
  for (int i = 0; i < tolerance::kCompromiseSteps; ++i) {
    centre = lambda;
    if (!pivoting.solve(box, tolerance::kCompromise, centre, lambda)) break;
    bool enough;
    bestError = errorOf(enough), best = lambda;
    if (enough) break;
  }
  pivots += pivoting.pivots();
  if (firmError < .5 * bestError) best = firm, bestError = firmError;
  lambda = best;
  return sweep(tolerance::kMostSweeps);
}

const BoxResult& BoxSolver::solve(const BoxProblem& problem, std::span<const double> start) {
  const std::size_t n = problem.size();
  assert((n == 0 || problem.offsets.size() == n + 1) && problem.lower.size() == n &&
         problem.upper.size() == n && (start.empty() || start.size() == n));
  if (n == 0) return result_ = {{}, 0, 0, 0, true};
  if (n <= 2 && solveSmall(problem, result_)) return result_;

  Work& w = *work_;
  w.scale(problem);
  w.startAt(problem, start);
  bool isGuess = !start.empty();
  result_.converged = false;
  for (const double added : tolerance::kProximal) {
    if (result_.converged) break;
    result_.converged = w.iterate(added, isGuess);
    isGuess = false;
  }
  if (!result_.converged) result_.converged = w.fallBack();

  result_.lambda.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    result_.lambda[i] = w.root[i] > 0
                            ? std::clamp(w.best[i] / w.root[i], problem.lower[i], problem.upper[i])
                            : std::clamp(0., problem.lower[i], problem.upper[i]);
  result_.residual = w.largest > 0 ? w.bestError / w.largest : w.bestError;
  result_.pivots = w.pivots;
  result_.refinements = w.refinements;
  return result_;
}

}  // namespace yadefrag
