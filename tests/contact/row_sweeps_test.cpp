// Forces of rows: with a closed form, and with a known solution.

#include "contact/row_sweeps.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

/// (of the largest gap) What rows with common nodes may leave.
constexpr double kLeft = 1e-9;

Nodes threeNodes() {
  Nodes nodes = plainNodes(3);
  nodes.mass = {2, 3, 5};
  return nodes;
}

/// F = p (1+d) / {Δt² [1/m_S + (1−ξ)²/m_A + ξ²/m_B]} (eq. 3 to 7 for one active): damping adds to
/// the mass.
TEST(RowSweeps, OneNodeOnASegment) {
  const Nodes nodes = threeNodes();
  for (const double drag : {0., .25})
    for (const double xi : {0., .25, .3, .5, 1.}) {
      std::vector<ContactRow> rows{onSegment(0, 1, 2, xi, -1e-4)};
      EXPECT_LE(solveAll(rows, nodes, drag), 1e-18);
      const double mobile = (1. / 2 + (1 - xi) * (1 - xi) / 3 + xi * xi / 5) / (1 + drag);
      EXPECT_NEAR(rows[0].normalForce * kDt * kDt * mobile / 1e-4, 1, 1e-14);
      EXPECT_EQ(rows[0].tangentForce, 0);
      EXPECT_NEAR(gapAfter(rows[0], displacements(rows, nodes, drag)), 0, 1e-18);
    }
}

TEST(RowSweeps, NothingPullsAndAnOldOverlapIsLeft) {
  const Nodes nodes = threeNodes();
  std::vector<ContactRow> rows{onSegment(0, 1, 2, .5, 1e-4)};
  solveAll(rows, nodes);
  EXPECT_EQ(rows[0].normalForce, 0);
  rows[0].gap = -1e-4;
  rows[0].toleratedGap = -9e-5;
  solveAll(rows, nodes);
  EXPECT_NEAR(gapAfter(rows[0], displacements(rows, nodes)), -9e-5, 1e-18);
  rows[0].toleratedGap = -2e-4;
  solveAll(rows, nodes);
  EXPECT_EQ(rows[0].normalForce, 0);
}

/// A held node has infinite mass, in each direction by itself.
TEST(RowSweeps, InfiniteMasses) {
  Nodes nodes = threeNodes();
  nodes.held = {kFree, kHeldXY, kHeldY};
  std::vector<ContactRow> rows{onSegment(0, 1, 2, .4, -1e-4)};
  solveAll(rows, nodes);
  EXPECT_NEAR(rows[0].normalForce * kDt * kDt / 2 / 1e-4, 1, 1e-14) << "the slave alone gives way";
  nodes.held[0] = kHeldXY;
  rows[0].normalForce = 0;
  EXPECT_EQ(solveAll(rows, nodes), 0) << "no node can move";
  EXPECT_EQ(rows[0].normalForce, 0);
}

/// A node between two fixed faces, nearer to each other than possible: no force is a solution, and
/// the sweeps increase both by the same amount each time.
TEST(RowSweeps, RowsThatContradictEachOtherGetNoMoreThanBySweeps) {
  Nodes nodes = plainNodes(3);
  nodes.held = {kFree, kHeldXY, kHeldXY};
  for (const double angle : {0., 1e-3, 1e-2}) {
    std::vector<ContactRow> rows{onSegment(0, 1, 2, .5, -1e-6, .5), onSegment(0, 1, 2, .5, -1e-6)};
    rows[1].normal = {std::sin(angle), -std::cos(angle)};
    RowSweeps sweeps;
    solveRows(sweeps, rows, {nodes, kDt}, {1e-9, 80});
    const double one = 1e-6 * nodes.mass[0] / (kDt * kDt);
    for (const ContactRow& row : rows)
      EXPECT_LE(row.normalForce, 2 * sweeps.sweeps() * one) << "at an angle of " << angle;
  }
}

TEST(RowSweeps, MomentumOfTwoBodiesIsKept) {
  Random random(31);
  for (int scene = 0; scene < 300; ++scene) {
    const std::size_t slaves = 1 + random() % 9, masters = 2 + random() % 9;
    Nodes nodes = plainNodes(slaves + masters);
    for (double& mass : nodes.mass) mass = even(random, .2, 3);
    std::vector<ContactRow> rows;
    for (std::size_t s = 0; s < slaves; ++s) {
      const std::size_t a = slaves + random() % (masters - 1);
      rows.push_back(onSegment(s, a, a + 1, even(random, 0, 1), even(random, -2e-4, 1e-4),
                               scene % 2 == 0 ? 0 : .4, even(random, -1e-4, 1e-4)));
      const double angle = even(random, 0, 7);
      rows.back().normal = {std::cos(angle), std::sin(angle)};
    }
    EXPECT_LE(solveAll(rows, nodes), 1e-17);
    const std::vector<Vec2> u = displacements(rows, nodes);
    Vec2 sum;
    double size = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      sum += nodes.mass[n] * u[n];
      size += nodes.mass[n] * norm(u[n]);
    }
    EXPECT_LE(norm(sum), 1e-14 * size);
    const double left = 2e-4 * kLeft;
    for (const ContactRow& row : rows) {
      EXPECT_GE(row.normalForce, 0);
      EXPECT_GE(gapAfter(row, u), -left);
      EXPECT_LE(std::abs(row.tangentForce), row.friction * row.normalForce);
      if (row.normalForce > 0) {
        EXPECT_NEAR(gapAfter(row, u), 0, left);
      }
    }
  }
}

/// μ = .5, a penetration of 1e-4: in one direction as mobile as in the other, the node sticks if
/// the slip is at most 5e-5, else the friction force is μ times the normal one, against the slip.
TEST(RowSweeps, FrictionSticksOrSlips) {
  const Nodes nodes = threeNodes();
  for (const double slip : {0., 1e-5, -4.9e-5, 4.9e-5, 5.1e-5, -2e-4, 1e-3}) {
    SCOPED_TRACE(slip);
    std::vector<ContactRow> rows{onSegment(0, 1, 2, .25, -1e-4, .5, slip)};
    EXPECT_LE(solveAll(rows, nodes), 1e-17);
    const std::vector<Vec2> u = displacements(rows, nodes);
    EXPECT_NEAR(gapAfter(rows[0], u), 0, 1e-18);
    if (std::abs(slip) <= 5e-5) {
      EXPECT_NEAR(slipAfter(rows[0], u), 0, 1e-18);
    } else {
      EXPECT_NEAR(rows[0].tangentForce, std::copysign(.5 * rows[0].normalForce, -slip),
                  1e-14 * rows[0].normalForce);
      EXPECT_NEAR(slipAfter(rows[0], u), std::copysign(std::abs(slip) - 5e-5, slip), 1e-17);
    }
  }
}

/// Both corners of a block of two nodes on one rigid floor, tilted: where normal and tangential
/// forces meet in one node, all conditions hold together.
TEST(RowSweeps, FrictionOfCoupledRows) {
  Nodes nodes = plainNodes(5);
  nodes.held[2] = nodes.held[3] = nodes.held[4] = kHeldXY;
  std::vector<ContactRow> rows{onSegment(0, 2, 3, .5, -1e-4, .3, 8e-5),
                               onSegment(0, 3, 4, .5, -5e-5, .3, -2e-5),
                               onSegment(1, 3, 4, .5, -1e-4, .3, 1e-5)};
  rows[1].normal = {.6, .8};
  EXPECT_LE(solveAll(rows, nodes), 1e-17);
  const std::vector<Vec2> u = displacements(rows, nodes);
  for (const ContactRow& row : rows) {
    const double most = row.friction * row.normalForce;
    EXPECT_GE(gapAfter(row, u), -1e-15);
    EXPECT_LE(std::abs(row.tangentForce), most);
    // Within the bounds there is no slip, at a bound it is against the force.
    if (std::abs(row.tangentForce) < most * (1 - 1e-9)) {
      EXPECT_NEAR(slipAfter(row, u), 0, 1e-15);
    } else {
      EXPECT_LE(slipAfter(row, u) * row.tangentForce, 0);
    }
  }
}

/// Rows twice over, and both exchanges of master and slave of faces whose nodes meet: the sum of
/// the forces is that of one row, and none pulls.
TEST(RowSweeps, RedundantRows) {
  const Nodes nodes = threeNodes();
  std::vector<ContactRow> single{onSegment(0, 1, 2, .25, -1e-4)};
  std::vector<ContactRow> twice{single[0], single[0], single[0]};
  solveAll(single, nodes);
  EXPECT_LE(solveAll(twice, nodes), 1e-17);
  double sum = 0;
  for (const ContactRow& row : twice) {
    EXPECT_GE(row.normalForce, 0);
    sum += row.normalForce;
  }
  EXPECT_NEAR(sum / single[0].normalForce, 1, 10 * kLeft);
}

TEST(RowSweeps, BothPassesOfMatchingFaces) {
  constexpr std::size_t kNodes = 40;  // of each face; node i of one lies on node i of the other
  Nodes nodes = plainNodes(2 * kNodes);
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i + 1 < kNodes; ++i) {
    rows.push_back(onSegment(i, kNodes + i, kNodes + i + 1, 0, -1e-4));
    rows.push_back(onSegment(kNodes + i, i, i + 1, 0, -1e-4));
    rows.back().normal = {0, -1};
  }
  EXPECT_LE(solveAll(rows, nodes), 1e-17);
  const std::vector<Vec2> u = displacements(rows, nodes);
  for (std::size_t i = 0; i + 1 < kNodes; ++i) {
    EXPECT_GE(rows[2 * i].normalForce, 0);
    EXPECT_GE(rows[2 * i + 1].normalForce, 0);
    EXPECT_NEAR(u[i].y, 5e-5, 1e-4 * 100 * kLeft);
    EXPECT_NEAR(u[kNodes + i].y, -5e-5, 1e-4 * 100 * kLeft);
  }
}

/// Gaps such that random forces solve the problem: 0, or with a closed gap. The gaps that they
/// leave are unique, also where the forces are not. Returns these gaps.
std::vector<double> plantSolution(Random& random, std::vector<ContactRow>& rows,
                                  const Nodes& nodes) {
  std::vector<double> left(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool isOpen = random() % 3 == 0;
    rows[r].gap = 0;
    rows[r].normalForce = isOpen ? 0 : even(random, 0, 100);
    left[r] = isOpen ? even(random, 0, 1e-4) : 0;
  }
  const std::vector<Vec2> u = displacements(rows, nodes);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r].gap = left[r] - gapAfter(rows[r], u);
    rows[r].normalForce = 0;
  }
  return left;
}

void expectPlanted(Random& random, std::vector<ContactRow> rows, const Nodes& nodes) {
  const std::vector<double> left = plantSolution(random, rows, nodes);
  EXPECT_LE(solveAll(rows, nodes, 0, {2e-7, 1000}), 2e-7);
  const std::vector<Vec2> u = displacements(rows, nodes);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_GE(rows[r].normalForce, 0);
    ASSERT_NEAR(gapAfter(rows[r], u), left[r], 3e-6) << r << " of " << rows.size();
  }
}

TEST(RowSweeps, FindAKnownSolution) {
  Random random(32);
  for (const auto& [a, b] :
       {std::pair<std::size_t, std::size_t>{1, 1}, {4, 6}, {10, 33}, {40, 40}}) {
    Nodes nodes = plainNodes(a + b + 2);
    for (double& mass : nodes.mass) mass = even(random, .5, 2);
    expectPlanted(random, bothFaces(a, b), nodes);
  }
}

/// What a limit of sweeps leaves goes on in the next solution of the step, also with the same gaps.
TEST(RowSweeps, ALaterSolutionGoesOn) {
  Random random(34);
  const Nodes nodes = plainNodes(25);
  std::vector<ContactRow> rows = bothFaces(10, 13);
  const std::vector<double> left = plantSolution(random, rows, nodes);
  const RowSweeps::Stop stop{1e-7, 2};
  RowSweeps sweeps;
  int solutions = 0;
  for (double change = INFINITY; change > stop.change && solutions < 1000; ++solutions)
    change = solveRows(sweeps, rows, {nodes, kDt, 0}, stop);
  EXPECT_GT(solutions, 2);
  const std::vector<Vec2> u = displacements(rows, nodes);
  for (std::size_t r = 0; r < rows.size(); ++r) ASSERT_NEAR(gapAfter(rows[r], u), left[r], 3e-6);
}

/// Halfpoints of a smooth surface on a rigid plane: row i moves nodes i and i + 1.
TEST(RowSweeps, ChainOfHalfpoints) {
  Random random(33);
  for (const std::size_t count : {3U, 40U, 1000U}) {
    const Nodes nodes = plainNodes(count + 1);
    std::vector<ContactRow> rows;
    for (std::size_t i = 0; i < count; ++i) {
      ContactRow& row = rows.emplace_back();
      row.normal = {0, 1};
      row.add({{NodeId(i), NodeId(i + 1), {}}, {.5, .5, 0}, 2}, 1);
    }
    expectPlanted(random, rows, nodes);
  }
}

}  // namespace
}  // namespace yadefrag::test
