#pragma once
// Problems of contact forces for the tests of their solver, and what is true of a solution.

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>

#include "contact/box_problem.hpp"
#include "core/random.hpp"
#include "core/tolerances/solver.hpp"

namespace yadefrag::test {

/// What the solver promises, and some rounding.
inline constexpr double kResidual = 1.01 * tolerance::kBoxResidual;

using Dense = std::vector<std::vector<double>>;

inline BoxProblem fromDense(const Dense& m) {
  BoxProblem p;
  std::vector<MatrixEntry> entries;
  for (std::uint32_t i = 0; i < m.size(); ++i)
    for (std::uint32_t j = 0; j < m.size(); ++j)
      if (m[i][j] != 0) entries.push_back({i, j, m[i][j]});
  p.setMatrix(m.size(), entries);
  p.constant.assign(m.size(), 0);
  p.lower.assign(m.size(), 0);
  p.upper.assign(m.size(), kNoBound);
  return p;
}

/// A row as a combination of unknowns (the displacements of nodes), in contact problems a few.
using Row = std::vector<std::pair<std::uint32_t, double>>;

/// G = W M⁻¹ Wᵀ.
inline BoxProblem fromRows(const std::vector<Row>& rows, const std::vector<double>& inverseMass) {
  std::vector<std::vector<std::pair<std::uint32_t, double>>> users(inverseMass.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    for (const auto& [node, weight] : rows[i]) users[node].emplace_back(i, weight);
  std::vector<MatrixEntry> entries;
  for (std::size_t node = 0; node < users.size(); ++node)
    for (const auto& [i, a] : users[node])
      for (const auto& [j, b] : users[node]) entries.push_back({i, j, a * inverseMass[node] * b});
  BoxProblem p;
  p.setMatrix(rows.size(), entries);
  p.constant.assign(rows.size(), 0);
  p.lower.assign(rows.size(), 0);
  p.upper.assign(rows.size(), kNoBound);
  return p;
}

inline std::vector<double> product(const BoxProblem& p, const std::vector<double>& x) {
  std::vector<double> sum(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k)
      sum[i] += p.values[k] * x[p.columns[k]];
  return sum;
}

inline double diagonal(const BoxProblem& p, std::size_t i) {
  for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k)
    if (p.columns[k] == i) return p.values[k];
  return 0;
}

inline double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

/// The error as the header defines it, found independently of the solver.
inline double trueResidual(const BoxProblem& p, const std::vector<double>& lambda) {
  auto r = product(p, lambda);
  double error = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    r[i] += p.constant[i];
    const double d = diagonal(p, i);
    EXPECT_TRUE(lambda[i] >= p.lower[i] && lambda[i] <= p.upper[i]);
    if (d == 0) continue;
    const double moved = std::clamp(lambda[i] - r[i] / d, p.lower[i], p.upper[i]);
    error = std::max(error, d * std::abs(lambda[i] - moved));
  }
  const double scale = largest(p.constant);
  return scale > 0 ? error / scale : error;
}

/// g such that a known λ solves the problem; r is unique even where λ is not.
inline std::vector<double> plantSolution(Random& random, BoxProblem& p) {
  std::vector<double> lambda(p.size());
  std::vector<double> r(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool friction = std::isfinite(p.upper[i]);
    const int where = int(random() % 4);
    lambda[i] = friction ? even(random, p.lower[i], p.upper[i]) : even(random, 0, 1);
    if (where == 0) lambda[i] = p.lower[i], r[i] = even(random, 0, 1);
    if (where == 1 && friction) lambda[i] = p.upper[i], r[i] = even(random, -1, 0);
    if (where == 2) lambda[i] = p.lower[i];  // both zero
  }
  auto pushed = product(p, lambda);
  for (std::size_t i = 0; i < p.size(); ++i) p.constant[i] = r[i] - pushed[i];
  return pushed;
}

inline void expectPlanted(const BoxProblem& p, const std::vector<double>& pushed,
                          const BoxResult& result, double tolerance) {
  ASSERT_TRUE(result.converged) << result.residual;
  ASSERT_LT(trueResidual(p, result.lambda), kResidual);
  const auto found = product(p, result.lambda);
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_NEAR(found[i], pushed[i], tolerance * largest(p.constant)) << i;
}

/// Halfpoints of a smooth surface on a rigid plane: row i couples nodes i and i + 1.
inline std::vector<Row> halfpoints(std::uint32_t n) {
  std::vector<Row> rows(n);
  for (std::uint32_t i = 0; i < n; ++i) rows[i] = {{i, .5}, {i + 1, .5}};
  return rows;
}

}  // namespace yadefrag::test
