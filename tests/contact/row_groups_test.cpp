// Groups of rows with common nodes: each has the forces that it has alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "contact/row_scenes.hpp"
#include "core/threads_for_few.hpp"

namespace yadefrag::test {
namespace {

/// Rows that share no node get what they would get alone.
TEST(RowGroups, RowsWithoutACommonNodeDoNotInteract) {
  Nodes nodes = plainNodes(6);
  nodes.mass = {1, 2, 3, 4, 5, 6};
  std::vector<ContactRow> first{onSegment(0, 1, 2, .3, -1e-4, .2, 1e-5)};
  std::vector<ContactRow> second{onSegment(3, 4, 5, .7, -1e-9, .2, 1e-5)};
  std::vector<ContactRow> both{first[0], second[0]};
  solveAll(first, nodes);
  solveAll(second, nodes);
  solveAll(both, nodes);
  EXPECT_EQ(both[0].normalForce, first[0].normalForce);
  EXPECT_EQ(both[0].tangentForce, first[0].tangentForce);
  EXPECT_EQ(both[1].normalForce, second[0].normalForce);
  EXPECT_EQ(both[1].tangentForce, second[0].tangentForce);
}

/// Joints of several sizes with friction, each with nodes of its own, and their rows in turn.
struct Joints {
  Nodes nodes;
  std::vector<std::vector<ContactRow>> rows;  // by joint
  [[nodiscard]] std::vector<ContactRow> inTurn() const {
    std::vector<ContactRow> all;
    std::size_t most = 0;
    for (const auto& joint : rows) most = std::max(most, joint.size());
    for (std::size_t i = 0; i < most; ++i)
      for (const auto& joint : rows)
        if (i < joint.size()) all.push_back(joint[i]);
    return all;
  }
};

Joints manyJoints(Random& random) {
  Joints joints;
  std::size_t first = 0;
  for (int i = 0; i < 60; ++i) {
    const std::size_t a = 1 + random() % 12, b = 1 + random() % 12;
    auto& rows = joints.rows.emplace_back(bothFaces(a, b));
    for (ContactRow& row : rows) {
      for (int k = 0; k < row.count; ++k) row.node[k] = NodeId(row.node[k].value + first);
      row.gap = even(random, -1e-4, 2e-5), row.slip = even(random, -1e-4, 1e-4), row.friction = .4;
    }
    first += a + b + 2;
  }
  joints.nodes = plainNodes(first);
  for (double& mass : joints.nodes.mass) mass = even(random, .5, 2);
  return joints;
}

/// Bit by bit: the forces of a joint are those that it has alone, for any number of threads.
TEST(RowGroups, GroupsDoNotDependOnOthersNorOnThreads) {
  Random random(35);
  const Joints joints = manyJoints(random);
  std::vector<std::vector<ContactRow>> alone = joints.rows;
  const RowSweeps::Stop stop{1e-12, 80};
  for (auto& rows : alone) {
    RowSweeps sweeps;
    sweeps.solve(rows, {joints.nodes, kDt, 0}, stop);
  }
  const std::vector<ContactRow> wanted = Joints{{}, alone}.inTurn();
  const ThreadsForFew few;
  for (const int threads : {1, 2, 3}) {
    std::vector<ContactRow> rows = joints.inTurn();
    ASSERT_EQ(rows.size(), wanted.size());
    RowSweeps sweeps;
    sweeps.solve(rows, {joints.nodes, kDt, 0}, stop, nullptr, threads);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      ASSERT_EQ(rows[r].normalForce, wanted[r].normalForce) << threads << " threads, row " << r;
      ASSERT_EQ(rows[r].tangentForce, wanted[r].tangentForce) << threads << " threads, row " << r;
    }
  }
}

}  // namespace
}  // namespace yadefrag::test
