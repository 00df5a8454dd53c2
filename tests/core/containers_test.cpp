// Containers of core, and tables of values in time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/columns.hpp"
#include "core/csr.hpp"
#include "core/disjoint_sets.hpp"
#include "core/work_list.hpp"
#include "mesh/model.hpp"
#include "mesh/motion.hpp"

namespace yadefrag::test {
namespace {

TEST(Csr, RowsKeepTheOrderOfTheItems) {
  for (const std::vector<int>& keys : {std::vector{2, 0, 2, 3, 0, 2}, std::vector<int>{}}) {
    Csr<int> csr;
    fillRows(
        csr, 5, keys.size(), [&](std::size_t i) { return keys[i]; },
        [](std::size_t i) { return static_cast<int>(i); });
    ASSERT_EQ(csr.rows(), 5U);
    std::vector<std::vector<int>> expected(5);
    for (std::size_t i = 0; i < keys.size(); ++i) expected[keys[i]].push_back(static_cast<int>(i));
    for (std::size_t r = 0; r < 5; ++r)
      EXPECT_EQ(std::vector<int>(csr.row(r).begin(), csr.row(r).end()), expected[r]) << "row " << r;
  }
  EXPECT_EQ(Csr<int>().rows(), 0U);
}

TEST(Csr, OffsetsDoNotWrap) {
  Csr<char> csr;
  const auto none = [](std::size_t) -> char { return 0; };
  EXPECT_THROW(fillRows(csr, 1, std::size_t{1} << 32, none, none), RunError);
  EXPECT_EQ(csr.rows(), 0U);
}

// --- disjoint sets

/// Against sets whose members are all renamed with each join.
TEST(DisjointSets, AreThoseOfAllThatHasBeenJoined) {
  std::mt19937_64 random(1);
  DisjointSets sets;
  for (int scene = 0; scene < 200; ++scene) {
    const std::size_t count = 1 + random() % 60;
    std::vector<std::uint32_t> name(count);
    for (std::uint32_t i = 0; i < count; ++i) name[i] = i;
    sets.reset(count);
    for (std::size_t k = random() % (2 * count); k > 0; --k) {
      const auto a = static_cast<std::uint32_t>(random() % count);
      const auto b = static_cast<std::uint32_t>(random() % count);
      sets.join(a, b);
      std::ranges::replace(name, std::uint32_t{name[a]}, std::uint32_t{name[b]});
    }
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = 0; b < count; ++b)
        ASSERT_EQ(sets.find(a) == sets.find(b), name[a] == name[b]);
  }
}

TEST(DisjointSets, LongChainsAreNoDeepCalls) {
  constexpr std::uint32_t kCount = 1'000'000;
  DisjointSets sets(kCount);
  for (std::uint32_t i = kCount - 1; i > 0; --i) sets.join(i - 1, i);
  EXPECT_EQ(sets.find(0), sets.find(kCount - 1));
  sets.reset(2);
  EXPECT_NE(sets.find(0), sets.find(1));
}

// --- columns

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

// --- work list

/// What a list of marks, looked at one after the other, visits.
std::vector<std::size_t> visitMarks(std::vector<bool>& marks, bool up,
                                    const std::vector<std::vector<std::size_t>>& added) {
  std::vector<std::size_t> visited;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::size_t at = up ? i : marks.size() - 1 - i;
    if (!marks[at]) continue;
    marks[at] = false;
    visited.push_back(at);
    for (const std::size_t other : added[at]) marks[other] = true;
  }
  return visited;
}

/// Each visit adds up to three others, before, behind, or itself; on both sides of words of 64.
TEST(WorkList, VisitsAsAListOfMarksDoes) {
  std::mt19937_64 random(3);
  std::size_t visits = 0;
  for (int scene = 0; scene < 300; ++scene) {
    const std::size_t count = 1 + random() % 200;
    std::vector<bool> marks(count, true);
    WorkList list;
    list.clear(count);
    for (std::size_t i = 0; i < count; ++i) list.add(i);
    for (int pass = 0; pass < 6; ++pass) {
      std::vector<std::vector<std::size_t>> added(count);
      for (auto& some : added)
        for (std::size_t k = random() % 8 < 4 ? random() % 4 : 0; k > 0; --k)
          some.push_back(random() % count);
      const std::size_t gone = random() % count;
      list.remove(gone), marks[gone] = false;
      const bool up = random() % 2 == 0;
      std::vector<std::size_t> visited;
      const auto visit = [&](std::size_t number) {
        visited.push_back(number);
        for (const std::size_t other : added[number]) list.add(other);
      };
      up ? list.visitUp(visit) : list.visitDown(visit);
      ASSERT_EQ(visited, visitMarks(marks, up, added)) << "scene " << scene << ", pass " << pass;
      visits += visited.size();
    }
  }
  EXPECT_GT(visits, 10000U);
}

TEST(WorkList, ARangeOfWordsIsVisitedAlone) {
  WorkList list;
  list.clear(200);
  for (const std::size_t number : {3U, 64U, 100U, 127U, 128U, 199U}) list.add(number);
  std::vector<std::size_t> visited;
  const auto visit = [&](std::size_t number) { visited.push_back(number); };
  list.visitUp({1, 2}, visit);
  EXPECT_EQ(visited, (std::vector<std::size_t>{64, 100, 127}));
  EXPECT_FALSE(list.contains(100));
  EXPECT_TRUE(list.contains(3) && list.contains(128));
  list.visitDown({2, 4}, visit);
  EXPECT_EQ(visited, (std::vector<std::size_t>{64, 100, 127, 199, 128}));
}

// --- time table

TEST(TimeTable, IsLinearBetweenItsTimesAndConstantOutside) {
  const TimeTable table({1, 2, 4}, {10, 30, 20});
  for (const auto& [time, value] :
       {std::pair{-5., 10.}, {1., 10.}, {1.5, 20.}, {2., 30.}, {3., 25.}, {4., 20.}, {9., 20.}})
    EXPECT_DOUBLE_EQ(table.at(time), value) << time;
  EXPECT_EQ(TimeTable().at(1), 0);
}

TEST(TimeTable, IntegralIsTheAreaBelow) {
  const TimeTable table({1, 2, 4}, {10, 30, 20});
  EXPECT_DOUBLE_EQ(table.integral(1, 2), 20);
  EXPECT_DOUBLE_EQ(table.integral(2, 4), 50);
  EXPECT_DOUBLE_EQ(table.integral(0, 6), 10 + 20 + 50 + 40);
  EXPECT_DOUBLE_EQ(table.integral(6, 0), -120);
  EXPECT_DOUBLE_EQ(table.integral(1.5, 3), .5 * 25 + 27.5);
  EXPECT_DOUBLE_EQ(TimeTable(7).integral(-1, 2), 21);
  EXPECT_EQ(TimeTable().integral(0, 1), 0);
}

TEST(TimeTable, ReportsWhatIsNoTable) {
  EXPECT_TRUE(TimeTable::isValid({0, 1}, {5, 5}));
  EXPECT_FALSE(TimeTable::isValid({}, {}));
  EXPECT_FALSE(TimeTable::isValid({0, 1}, {5}));
  EXPECT_FALSE(TimeTable::isValid({1, 1}, {5, 5}));
  EXPECT_FALSE(TimeTable::isValid({0, INFINITY}, {5, 5}));
  EXPECT_FALSE(TimeTable::isValid({0, 1}, {5, NAN}));
}

}  // namespace
}  // namespace yadefrag::test
