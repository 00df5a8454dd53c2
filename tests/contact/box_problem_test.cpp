// Small problems, each state of which can be tried, and what goes wrong in others.

#include "contact/box_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/box_problems.hpp"

namespace yadefrag::test {
namespace {

/// Gaussian elimination with pivoting on the free rows of one state; false if singular.
bool solveState(const BoxProblem& p, const Dense& m, const std::vector<int>& state,
                std::vector<double>& lambda) {
  const std::size_t n = p.size();
  Dense a(n, std::vector<double>(n + 1, 0));
  for (std::size_t i = 0; i < n; ++i) {
    if (state[i] == 0) {
      for (std::size_t j = 0; j < n; ++j) a[i][j] = m[i][j];
      a[i][n] = -p.constant[i];
    } else {
      const double bound = state[i] == 1 ? p.lower[i] : p.upper[i];
      if (!std::isfinite(bound)) return false;
      a[i][i] = 1;
      a[i][n] = bound;
    }
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t best = c;
    for (std::size_t i = c; i < n; ++i)
      if (std::abs(a[i][c]) > std::abs(a[best][c])) best = i;
    if (std::abs(a[best][c]) < 1e-12) return false;
    std::swap(a[c], a[best]);
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = i == c ? 0 : a[i][c] / a[c][c];
      for (std::size_t j = c; factor != 0 && j <= n; ++j) a[i][j] -= factor * a[c][j];
    }
  }
  lambda.resize(n);
  for (std::size_t i = 0; i < n; ++i) lambda[i] = a[i][n] / a[i][i];
  return true;
}

/// Looks at all 3ⁿ states; the λ with the least residual.
std::vector<double> bruteForce(const BoxProblem& p, const Dense& m) {
  const std::size_t n = p.size();
  std::size_t states = 1;
  for (std::size_t i = 0; i < n; ++i) states *= 3;
  std::vector<double> best;
  double bestResidual = 1e300;
  std::vector<int> state(n);
  for (std::size_t code = 0; code < states; ++code) {
    std::size_t rest = code;
    for (std::size_t i = 0; i < n; ++i, rest /= 3) state[i] = int(rest % 3);
    std::vector<double> lambda;
    if (!solveState(p, m, state, lambda)) continue;
    bool feasible = true;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::abs(lambda[i] - p.lower[i]) < 1e-11) lambda[i] = p.lower[i];
      if (std::abs(lambda[i] - p.upper[i]) < 1e-11) lambda[i] = p.upper[i];
      feasible = feasible && lambda[i] >= p.lower[i] && lambda[i] <= p.upper[i];
    }
    if (!feasible) continue;
    const double residual = trueResidual(p, lambda);
    if (residual < bestResidual) bestResidual = residual, best = lambda;
  }
  EXPECT_LT(bestResidual, 1e-7);
  return best;
}

Dense randomDefinite(Random& random, std::size_t n, double condition) {
  // A Gram matrix of random rows whose columns have very different weights.
  Dense rows(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      rows[i][j] = even(random, -1, 1) * std::pow(condition, -.5 * double(j) / double(n));
  Dense m(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k) m[i][j] += rows[i][k] * rows[j][k];
  return m;
}

void randomBounds(Random& random, BoxProblem& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.constant[i] = even(random, -2, 1);
    if (random() % 2) continue;
    const double bound = random() % 4 == 0 ? 0 : even(random, 0, 2);  // friction
    p.lower[i] = -bound, p.upper[i] = bound;
  }
}

TEST(BoxProblem, MatrixOfEntriesAddsUpRepeatedOnes) {
  BoxProblem p;
  const MatrixEntry entries[] = {{2, 0, 1}, {0, 2, 1},  {1, 1, 4}, {0, 0, 2},
                                 {2, 2, 5}, {1, 1, .5}, {2, 0, 2}, {0, 2, 2}};
  p.setMatrix(4, entries);
  EXPECT_EQ(p.offsets, (std::vector<std::uint32_t>{0, 2, 3, 5, 5}));
  EXPECT_EQ(p.columns, (std::vector<std::uint32_t>{0, 2, 1, 0, 2}));
  EXPECT_EQ(p.values, (std::vector<double>{2, 3, 4.5, 3, 5}));
}

TEST(BoxSolver, AgreesWithAllStatesTried) {
  Random random(1);
  BoxSolver solver;
  for (int k = 0; k < 3000; ++k) {
    const std::size_t n = 1 + random() % 6;
    if (n > 4 && k % 5) continue;
    const Dense m = randomDefinite(random, n, k % 3 ? 10 : 1e4);
    BoxProblem p = fromDense(m);
    randomBounds(random, p);
    const BoxResult& result = solver.solve(p);
    ASSERT_TRUE(result.converged) << k << " n " << n << " residual " << result.residual;
    ASSERT_LT(trueResidual(p, result.lambda), kResidual);
    const auto expected = bruteForce(p, m);
    const double scale = 1 + largest(expected);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_NEAR(result.lambda[i], expected[i], 1e-6 * scale) << k << " n " << n;
  }
}

TEST(BoxSolver, RedundantAndZeroRows) {
  Random random(2);
  BoxSolver solver;
  for (int k = 0; k < 5000; ++k) {
    const std::size_t unknowns = 1 + random() % 5;
    std::vector<Row> rows(2 + random() % 8);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i > 0 && random() % 3 == 0) {
        rows[i] = rows[random() % i];
        const double factor = even(random, .5, 2);
        for (auto& [node, weight] : rows[i]) weight *= factor;
      } else {
        for (std::uint32_t u = 0; u < unknowns; ++u)
          if (random() % 2) rows[i].emplace_back(u, even(random, -1, 1));
      }
    }
    std::vector<double> inverseMass(unknowns);
    for (double& m : inverseMass) m = std::pow(10., even(random, -2, 2));
    BoxProblem p = fromRows(rows, inverseMass);
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (random() % 3) continue;
      p.upper[i] = random() % 3 ? even(random, 0, 1) : 0;
      p.lower[i] = -p.upper[i];
    }
    const auto pushed = plantSolution(random, p);
    if (largest(p.constant) == 0) continue;
    SCOPED_TRACE(k);
    expectPlanted(p, pushed, solver.solve(p), 1e-5);
    if (HasFatalFailure()) return;
  }
}

TEST(BoxSolver, AnyUnits) {
  // G in 10ᵃ m/N and g in 10ᵇ m: λ scales by 10ᵇ⁻ᵃ and nothing else changes.
  Random random(5);
  BoxSolver solver;
  for (const std::uint32_t n : {1, 2, 5, 30, 200})
    for (const auto& [a, b] : {std::pair{-30, -12}, {-30, 12}, {-12, -30}, {12, -30}, {12, 12}}) {
      BoxProblem p = fromRows(halfpoints(n), std::vector<double>(n + 1, 1));
      plantSolution(random, p);
      const std::vector<double> expected = solver.solve(p).lambda;
      for (double& value : p.values) value *= std::pow(10., a);
      for (double& value : p.constant) value *= std::pow(10., b);
      const BoxResult& result = solver.solve(p);
      EXPECT_TRUE(result.converged) << n << ' ' << a << ' ' << b << ' ' << result.residual;
      const double factor = std::pow(10., b - a);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(result.lambda[i] / factor, expected[i], 1e-6 * (1 + largest(expected)));
    }
}

TEST(BoxSolver, MassesOfVeryDifferentSizeInOneGroup) {
  Random random(6);
  BoxSolver solver;
  for (int k = 0; k < 200; ++k) {
    const std::uint32_t n = 5 + random() % 60;
    std::vector<double> inverseMass(n + 1);
    for (double& m : inverseMass) m = std::pow(10., even(random, -5, 5));
    BoxProblem p = fromRows(halfpoints(n), inverseMass);
    for (double& g : p.constant) g = even(random, -1, .2);
    const BoxResult& result = solver.solve(p);
    ASSERT_TRUE(result.converged) << k << ' ' << result.residual;
    ASSERT_LT(trueResidual(p, result.lambda), kResidual);
  }
}

TEST(BoxSolver, FixedNodesLeaveLambdaAtZero) {
  BoxSolver solver;
  for (const std::size_t n : {1, 2, 3}) {
    BoxProblem p = fromDense(Dense(n, std::vector<double>(n, 0)));
    p.constant.assign(n, -1);
    const BoxResult& result = solver.solve(p);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.lambda, std::vector<double>(n, 0));
  }
  EXPECT_TRUE(solver.solve(fromDense({})).converged);
}

TEST(BoxSolver, NoSolutionEndsWithABoundedCompromise) {
  // A node between two walls that are too near: the gaps add up to −1 whatever it does.
  BoxSolver solver;
  for (const double uneven : {1., 1.5}) {
    BoxProblem p = fromRows({{{0, 1}}, {{0, -uneven}}, {{1, 1}}}, {1, 1});
    p.constant = {-.5, -.5, -.25};
    const BoxResult& result = solver.solve(p);
    EXPECT_FALSE(result.converged);
    EXPECT_GT(result.residual, .4);
    EXPECT_LT(largest(result.lambda), 300);
    EXPECT_NEAR(result.lambda[2], .25, 1e-6);
  }
}

TEST(BoxSolver, NotANumberIsReported) {
  BoxSolver solver;
  for (const std::uint32_t n : {1, 2, 3, 60}) {
    BoxProblem p = fromRows(halfpoints(n), std::vector<double>(n + 1, 1));
    p.constant.assign(n, -1);
    p.constant[n / 2] = std::nan("");
    const BoxResult& result = solver.solve(p);
    EXPECT_FALSE(result.converged) << n;
    for (const double value : result.lambda) EXPECT_TRUE(std::isfinite(value)) << n;
  }
}

}  // namespace
}  // namespace yadefrag::test
