#include "core/time_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace yadefrag {
namespace {

TEST(TimeTable, IsLinearBetweenItsTimesAndConstantOutside) {
  const TimeTable table({1, 2, 4}, {10, 30, 20});
  for (const auto& [time, value] :
       {std::pair{-5., 10.}, {1., 10.}, {1.5, 20.}, {2., 30.}, {3., 25.}, {4., 20.}, {9., 20.}})
    EXPECT_DOUBLE_EQ(table.at(time), value) << time;
}

TEST(TimeTable, IntegralIsTheAreaBelow) {
  const TimeTable table({1, 2, 4}, {10, 30, 20});
  EXPECT_DOUBLE_EQ(table.integral(1, 2), 20);
  EXPECT_DOUBLE_EQ(table.integral(2, 4), 50);
  EXPECT_DOUBLE_EQ(table.integral(0, 6), 10 + 20 + 50 + 40);
  EXPECT_DOUBLE_EQ(table.integral(6, 0), -120);
  EXPECT_DOUBLE_EQ(table.integral(1.5, 3), .5 * 25 + 27.5);
  EXPECT_DOUBLE_EQ(TimeTable(7).integral(-1, 2), 21);
}

TEST(TimeTable, WithoutValuesIsZero) {
  EXPECT_EQ(TimeTable().at(1), 0);
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
}  // namespace yadefrag
