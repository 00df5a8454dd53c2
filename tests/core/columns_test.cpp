#include "core/columns.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesh/model.hpp"

namespace yadefrag::test {
namespace {

struct Table {
  std::vector<int> number;
  std::vector<double> rare;  // optional

  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"number"}, self.number);
      visit(Column{"rare", kOptional}, self.rare);
    };
  }
  auto columns() { return columnsOf(*this); }
  auto columns() const { return columnsOf(*this); }
};

TEST(Columns, UnusedOptionalArraysStayEmpty) {
  Table table;
  resizeRows(table.columns(), 3);
  table.number = {5, 6, 7};
  reserveRows(table.columns(), 100);
  EXPECT_GE(table.number.capacity(), 100U);
  appendCopy(table.columns(), 1);
  EXPECT_EQ(table.number, (std::vector{5, 6, 7, 6}));
  EXPECT_TRUE(table.rare.empty());
  EXPECT_EQ(table.rare.capacity(), 0U);
  EXPECT_TRUE(haveLength(table.columns(), 4));
  table.rare = {1};
  EXPECT_FALSE(haveLength(table.columns(), 4));
}

TEST(Columns, RowsAreKeptAndArranged) {
  Table table{{0, 1, 2, 3, 4}, {0, 10, 20, 30, 40}};
  // The rule may read the row itself.
  keepRows(table.columns(), 5, [&](std::size_t row) { return table.number[row] % 2 == 0; });
  EXPECT_EQ(table.number, (std::vector{0, 2, 4}));
  EXPECT_EQ(table.rare, (std::vector{0., 20., 40.}));
  const std::vector<NodeId> order{NodeId(2), NodeId(0), NodeId(1)};
  arrangeRows(table.columns(), std::span<const NodeId>(order));
  EXPECT_EQ(table.number, (std::vector{4, 0, 2}));
  EXPECT_EQ(table.rare, (std::vector{40., 0., 20.}));
  resizeRows(table.columns(), 4);
  EXPECT_EQ(table.number.back(), 0);
  EXPECT_EQ(table.rare.back(), 0);
}

/// A member that is missing in the list would not follow a crack: all members have their line.
TEST(Columns, AllArraysByNodeAndTriangleAreListed) {
  std::size_t bytes = 0;
  const auto measure = [&](const Column&, const auto& array) { bytes += sizeof array; };
  const Nodes nodes;
  nodes.columns()(measure);
  EXPECT_EQ(bytes, sizeof(Nodes));
  bytes = 0;
  const Triangles triangles;
  triangles.columns()(measure);
  EXPECT_EQ(bytes, sizeof(Triangles));
}

}  // namespace
}  // namespace yadefrag::test
