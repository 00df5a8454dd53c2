// Contact groups are the connected components of rows over the nodes that can move.

#include "contact/contact_groups.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <set>

#include "contact/contact_scenes.hpp"

namespace yadefrag::test {
namespace {

ContactRow rowOf(const std::vector<std::size_t>& nodes) {
  ContactRow row;
  for (const std::size_t node : nodes) {
    const auto at = static_cast<std::size_t>(row.count++);
    row.node[at] = NodeId(node);
    row.weight[at] = at == 0 ? 1 : -.5;
  }
  return row;
}

using Sets = std::set<std::set<std::uint32_t>>;

bool shareFreeNode(const ContactRow& a, const ContactRow& b, const Nodes& nodes) {
  for (int i = 0; i < a.count; ++i)
    for (int j = 0; j < b.count; ++j)
      if (a.node[i] == b.node[j] && nodes.held[a.node[i].value] != kHeldXY) return true;
  return false;
}

/// By flooding over all pairs of rows.
Sets bruteForce(const std::vector<ContactRow>& rows, const Nodes& nodes) {
  Sets groups;
  std::vector<bool> seen(rows.size(), false);
  for (std::uint32_t first = 0; first < rows.size(); ++first) {
    if (seen[first]) continue;
    std::set<std::uint32_t> group{first};
    std::vector<std::uint32_t> open{first};
    seen[first] = true;
    while (!open.empty()) {
      const std::uint32_t row = open.back();
      open.pop_back();
      for (std::uint32_t other = 0; other < rows.size(); ++other)
        if (!seen[other] && shareFreeNode(rows[row], rows[other], nodes)) {
          seen[other] = true;
          group.insert(other);
          open.push_back(other);
        }
    }
    groups.insert(group);
  }
  return groups;
}

Sets sets(const ContactGroups& groups) {
  Sets found;
  for (std::size_t g = 0; g < groups.rows.rows(); ++g) {
    const auto row = groups.rows.row(g);
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
    found.insert({row.begin(), row.end()});
  }
  EXPECT_EQ(found.size(), groups.rows.rows());
  return found;
}

/// Each free node of each row once, all rows of a node in the node's own group.
void expectLinks(const std::vector<ContactRow>& rows, const Nodes& nodes,
                 const ContactGroups& groups) {
  std::size_t expected = 0;
  for (const ContactRow& row : rows)
    for (int k = 0; k < row.count; ++k) expected += nodes.held[row.node[k].value] != kHeldXY;
  EXPECT_EQ(groups.links.size(), expected);
  std::size_t seen = 0;
  for (std::size_t g = 0; g < groups.rows.rows(); ++g)
    for (const std::uint32_t begin : groups.spans.row(g)) {
      const NodeId node = groups.links[begin].node;
      for (std::size_t i = begin; i < groups.links.size() && groups.links[i].node == node; ++i) {
        const auto members = groups.rows.row(g);
        EXPECT_TRUE(std::binary_search(members.begin(), members.end(), groups.links[i].row));
        ++seen;
      }
    }
  EXPECT_EQ(seen, expected);
}

TEST(ContactGroups, SameAsBruteForceOnRandomRows) {
  Random random(11);
  ContactGroups groups;
  for (int scene = 0; scene < 500; ++scene) {
    const std::size_t count = 1 + random() % 60;
    Nodes nodes = plainNodes(count);
    for (std::uint8_t& held : nodes.held)
      held = static_cast<std::uint8_t>(random() % 3 != 0 ? 0 : random() % 4);
    std::vector<ContactRow> rows;
    for (std::size_t r = random() % 40; r > 0; --r) {
      std::set<std::size_t> chosen;
      while (chosen.size() < std::min<std::size_t>(count, 1 + random() % 5))
        chosen.insert(random() % count);
      rows.push_back(rowOf({chosen.begin(), chosen.end()}));
    }
    findContactGroups(rows, nodes, groups);
    ASSERT_EQ(sets(groups), bruteForce(rows, nodes)) << "scene " << scene;
    expectLinks(rows, nodes, groups);
  }
}

TEST(ContactGroups, HeldNodesSeparate) {
  const std::vector<ContactRow> rows{rowOf({0, 4, 5}), rowOf({1, 5, 6}), rowOf({2, 6, 7})};
  Nodes nodes = plainNodes(8);
  ContactGroups groups;
  findContactGroups(rows, nodes, groups);
  EXPECT_EQ(sets(groups), (Sets{{0, 1, 2}}));
  nodes.held[5] = kHeldX;  // still moves along y
  findContactGroups(rows, nodes, groups);
  EXPECT_EQ(sets(groups), (Sets{{0, 1, 2}}));
  nodes.held[5] = nodes.held[6] = kHeldXY;
  findContactGroups(rows, nodes, groups);
  EXPECT_EQ(sets(groups), (Sets{{0}, {1}, {2}}));
}

TEST(ContactGroups, RowOfHeldNodesAloneHasNoLinks) {
  Nodes nodes = plainNodes(3);
  nodes.held.assign(3, kHeldXY);
  ContactGroups groups;
  findContactGroups(std::vector<ContactRow>{rowOf({0, 1, 2})}, nodes, groups);
  EXPECT_EQ(sets(groups), (Sets{{0}}));
  EXPECT_TRUE(groups.links.empty());
  EXPECT_TRUE(groups.spans.row(0).empty());
  findContactGroups({}, nodes, groups);
  EXPECT_EQ(groups.rows.rows(), 0U);
}

/// The groups of a flood do not depend on the order of rows; here a chain, forwards and backwards.
TEST(ContactGroups, LongChain) {
  constexpr std::size_t kRows = 3000;
  const Nodes nodes = plainNodes(kRows + 1);
  std::vector<ContactRow> rows;
  for (std::size_t r = 0; r < kRows; ++r) rows.push_back(rowOf({r, r + 1}));
  ContactGroups groups;
  for (int turn = 0; turn < 2; ++turn) {
    findContactGroups(rows, nodes, groups);
    ASSERT_EQ(groups.rows.rows(), 1U);
    EXPECT_EQ(groups.rows.row(0).size(), kRows);
    std::reverse(rows.begin(), rows.end());
  }
}

}  // namespace
}  // namespace yadefrag::test
