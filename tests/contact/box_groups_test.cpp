// Problems as contact poses them: chains of rows that share nodes, both passes, friction.

#include "contact/box_problem.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <random>

#include "contact/box_problems.hpp"

namespace yadefrag::test {
namespace {

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

}  // namespace
}  // namespace yadefrag::test
