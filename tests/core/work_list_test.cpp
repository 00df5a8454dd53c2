#include "core/work_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace yadefrag::test {
namespace {

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

}  // namespace
}  // namespace yadefrag::test
