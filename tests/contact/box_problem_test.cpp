#include "contact/box_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/tolerances.hpp"

namespace yadefrag {
namespace {

/// What the solver promises, and some rounding.
constexpr double kResidual = 1.01 * tolerance::kBoxResidual;

using Random = std::mt19937_64;
using Dense = std::vector<std::vector<double>>;

double even(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

BoxProblem fromDense(const Dense& m) {
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
BoxProblem fromRows(const std::vector<Row>& rows, const std::vector<double>& inverseMass) {
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

std::vector<double> product(const BoxProblem& p, const std::vector<double>& x) {
  std::vector<double> sum(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k)
      sum[i] += p.values[k] * x[p.columns[k]];
  return sum;
}

double diagonal(const BoxProblem& p, std::size_t i) {
  for (std::uint32_t k = p.offsets[i]; k < p.offsets[i + 1]; ++k)
    if (p.columns[k] == i) return p.values[k];
  return 0;
}

double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

/// The error as the header defines it, found independently of the solver.
double trueResidual(const BoxProblem& p, const std::vector<double>& lambda) {
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

/// g such that a known λ solves the problem; r is unique even where λ is not.
std::vector<double> plantSolution(Random& random, BoxProblem& p) {
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

void expectPlanted(const BoxProblem& p, const std::vector<double>& pushed, const BoxResult& result,
                   double tolerance) {
  ASSERT_TRUE(result.converged) << result.residual;
  ASSERT_LT(trueResidual(p, result.lambda), kResidual);
  const auto found = product(p, result.lambda);
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_NEAR(found[i], pushed[i], tolerance * largest(p.constant)) << i;
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

/// Halfpoints of a smooth surface on a rigid plane: row i couples nodes i and i + 1.
std::vector<Row> halfpoints(std::uint32_t n) {
  std::vector<Row> rows(n);
  for (std::uint32_t i = 0; i < n; ++i) rows[i] = {{i, .5}, {i + 1, .5}};
  return rows;
}

TEST(BoxSolver, ChainOfHalfpoints) {
  Random random(3);
  BoxSolver solver;
  for (const std::uint32_t n : {3, 40, 49, 200, 1000, 5000})
    for (int k = 0; k < 4; ++k) {
      std::vector<double> inverseMass(n + 1, 1);
      if (k % 2)
        for (double& m : inverseMass) m = even(random, .5, 2);
      BoxProblem p = fromRows(halfpoints(n), inverseMass);
      SCOPED_TRACE(n);
      if (k < 2) {  // all are pressed: nothing but the chain's bad condition
        for (std::size_t i = 0; i < n; ++i) p.constant[i] = -1 - .5 * std::sin(.01 * double(i));
        const BoxResult& result = solver.solve(p);
        EXPECT_TRUE(result.converged) << result.residual;
        EXPECT_LT(trueResidual(p, result.lambda), kResidual);
        EXPECT_LT(result.pivots, 80);
      } else {
        const auto pushed = plantSolution(random, p);
        const BoxResult& result = solver.solve(p);
        expectPlanted(p, pushed, result, 1e-5);
        RecordProperty("pivots" + std::to_string(n), result.pivots);
        if (HasFatalFailure()) return;
      }
    }
}

/// Two facing lines of nodes, coarse and fine; the slaves of both are rows. Unknown = normal
/// displacement (or, second copy, the tangential one) of a node.
std::vector<Row> bothPasses(std::uint32_t coarse, std::uint32_t fine, std::uint32_t shift) {
  std::vector<Row> rows;
  const auto across = [&](std::uint32_t slaves, std::uint32_t masters, std::uint32_t slave0,
                          std::uint32_t master0) {
    for (std::uint32_t s = 0; s <= slaves; ++s) {
      const double at = double(s) * masters / slaves;
      const auto m = std::min(std::uint32_t(at), masters - 1);
      Row row = {{shift + slave0 + s, 1}};
      const double xi = at - m;
      if (xi < 1) row.emplace_back(shift + master0 + m, xi - 1);
      if (xi > 0) row.emplace_back(shift + master0 + m + 1, -xi);
      rows.push_back(row);
    }
  };
  across(coarse, fine, 0, coarse + 1);
  across(fine, coarse, coarse + 1, 0);
  // The upper body is the slave of the first part and the master of the second: one sign for both.
  for (std::size_t i = coarse + 1; i < rows.size(); ++i)
    for (auto& [node, weight] : rows[i]) weight = -weight;
  return rows;
}

TEST(BoxSolver, BothPassesInOneSystem) {
  Random random(4);
  BoxSolver solver;
  const std::pair<std::uint32_t, std::uint32_t> meshes[] = {
      {1, 1}, {8, 12}, {10, 33}, {30, 31}, {600, 600}, {800, 1200}, {400, 1600}};
  for (const auto& [coarse, fine] : meshes)
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t nodes = coarse + fine + 2;
      std::vector<double> inverseMass(2 * std::size_t{nodes});
      for (std::uint32_t i = 0; i < nodes; ++i)
        inverseMass[i] = inverseMass[nodes + i] =
            (i <= coarse ? coarse : fine) * even(random, 1, 1.2);
      auto rows = bothPasses(coarse, fine, 0);
      const std::size_t normals = rows.size();
      const bool friction = k % 2 == 1;
      if (friction)
        for (const Row& row : bothPasses(coarse, fine, nodes)) rows.push_back(row);
      BoxProblem p = fromRows(rows, inverseMass);
      for (std::size_t i = normals; i < p.size(); ++i) {
        p.upper[i] = even(random, 0, .3);
        p.lower[i] = -p.upper[i];
      }
      SCOPED_TRACE(std::to_string(coarse) + ":" + std::to_string(fine) + " kind " +
                   std::to_string(k));
      if (k < 2) {
        // Gaps of a uniform pressing and noise: the two passes contradict each other a little.
        for (std::size_t i = 0; i < p.size(); ++i)
          p.constant[i] = i < normals ? -1 + .01 * even(random, -1, 1) : even(random, -1, 1);
        const BoxResult& result = solver.solve(p);
        EXPECT_TRUE(result.converged) << result.residual;
        EXPECT_LT(trueResidual(p, result.lambda), kResidual);
      } else {
        const auto pushed = plantSolution(random, p);
        expectPlanted(p, pushed, solver.solve(p), 1e-5);
        if (HasFatalFailure()) return;
      }
    }
}

/// Rows that are turned along a curved interface, so that normal and tangent forces are coupled.
std::vector<Row> turned(const std::vector<Row>& normal, const std::vector<Row>& tangent,
                        double turn, Random& random) {
  std::vector<Row> rows(2 * normal.size());
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const double angle = turn * double(i) / double(normal.size()) + even(random, -.02, .02);
    for (const auto& [node, weight] : normal[i]) {
      rows[i].emplace_back(node, weight * std::cos(angle));
      rows[normal.size() + i].emplace_back(node, -weight * std::sin(angle));
    }
    for (const auto& [node, weight] : tangent[i]) {
      rows[i].emplace_back(node, weight * std::sin(angle));
      rows[normal.size() + i].emplace_back(node, weight * std::cos(angle));
    }
  }
  return rows;
}

TEST(BoxSolver, FrictionBoundsThatFollowTheNormalForces) {
  // The hardest use: redundant rows, friction, noise, and a start of which every slipping row has a
  // new bound. Single least-index pivots took up to 900 factors here. (Around more than half a
  // circle the two lines lock, and these bounds have no limit.)
  Random random(8);
  BoxSolver solver;
  int pivots = 0;
  for (int k = 0; k < 150; ++k) {
    const auto coarse = 1 + std::uint32_t(std::pow(10., even(random, 0, k % 10 ? 1.7 : 2.5)));
    const auto fine = std::uint32_t(coarse * even(random, 1, 3));
    const std::uint32_t nodes = coarse + fine + 2;
    std::vector<double> inverseMass(2 * std::size_t{nodes});
    for (std::uint32_t i = 0; i < nodes; ++i)
      inverseMass[i] = inverseMass[nodes + i] = even(random, .5, 2);
    BoxProblem p = fromRows(turned(bothPasses(coarse, fine, 0), bothPasses(coarse, fine, nodes),
                                   even(random, 0, 1.5), random),
                            inverseMass);
    const std::size_t normals = p.size() / 2;
    const double noise = std::pow(10., even(random, -8, 0));
    for (std::size_t i = 0; i < p.size(); ++i)
      p.constant[i] = (i < normals ? -1 : std::sin(.1 * double(i))) + noise * even(random, -1, 1);
    std::vector<double> lambda;
    for (int pass = 0; pass < 4; ++pass) {
      for (std::size_t i = normals; i < p.size(); ++i) {
        p.upper[i] = pass == 0 ? 0 : .3 * lambda[i - normals];
        p.lower[i] = -p.upper[i];
      }
      const BoxResult& result = solver.solve(p, lambda);
      ASSERT_TRUE(result.converged) << k << " pass " << pass << ' ' << result.residual;
      ASSERT_LT(trueResidual(p, result.lambda), kResidual);
      pivots = std::max(pivots, result.pivots);
      lambda = result.lambda;
    }
  }
  EXPECT_LT(pivots, 80);
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

TEST(BoxSolver, WarmStartGivesTheSameAnswerWithFewerPivots) {
  Random random(7);
  BoxSolver solver;
  BoxProblem p = fromRows(halfpoints(500), std::vector<double>(501, 1));
  const auto pushed = plantSolution(random, p);
  const BoxResult cold = solver.solve(p);
  for (double& g : p.constant) g *= 1.001;
  const BoxResult warm = solver.solve(p, cold.lambda);
  EXPECT_TRUE(warm.converged);
  EXPECT_LE(warm.pivots, cold.pivots);
  EXPECT_LT(trueResidual(p, warm.lambda), kResidual);

  // The answer does not depend on what was solved before.
  BoxSolver other;
  EXPECT_EQ(other.solve(p, cold.lambda).lambda, warm.lambda);
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
}  // namespace yadefrag
