// The level that most boxes share, from which codes row by row are planned.
#include "search/search_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/tolerances/search.hpp"

namespace yadefrag {
namespace {

/// Boxes with sides from 1 to `ratio`, with a density proportional to side^-power.
std::vector<Box> boxesOfSizes(double power, double ratio) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> part(0, 1), place(0, 500);
  std::vector<Box> boxes(5000);
  for (Box& box : boxes) {
    const double e = 1 - power;
    const double side = e == 0 ? std::pow(ratio, part(random))
                               : std::pow(1 + part(random) * (std::pow(ratio, e) - 1), 1 / e);
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + side;
    }
  }
  return boxes;
}

double partOnLevel(const std::vector<Box>& boxes, double extent) {
  const auto count = std::ranges::count_if(boxes, [&](const Box& box) {
    return longestSide(box) <= extent && longestSide(box) > extent / 2;
  });
  return static_cast<double>(count) / static_cast<double>(boxes.size());
}

TEST(SearchPlan, TakesTheLevelOfMostBoxes) {
  // Of radii with equal volume per octave 7/8 are in the first octave; its end is cut by the
  // margin.
  const std::vector<Box> boxes = boxesOfSizes(4, 20);
  const SearchPlan plan = planSearch(boxes, tolerance::kEven);
  EXPECT_TRUE(plan.isEven);
  EXPECT_GT(partOnLevel(boxes, plan.extent), .8);
  const SearchPlan ofMedian = planSearch(boxes);
  EXPECT_FALSE(ofMedian.isEven);
  EXPECT_LT(partOnLevel(boxes, ofMedian.extent), .5);
}

TEST(SearchPlan, IsNotEvenIfNoLevelHasEnoughBoxes) {
  const std::vector<Box> boxes = boxesOfSizes(1, 1000);
  EXPECT_FALSE(planSearch(boxes, tolerance::kEven).isEven);
  EXPECT_TRUE(planSearch(boxes, .05).isEven);
}

TEST(SearchPlan, KeepsALevelThatServesAboutAsManyBoxes) {
  std::vector<Box> boxes = boxesOfSizes(1, 10);
  const double extent = planSearch(boxes, tolerance::kEven).extent;
  EXPECT_EQ(planSearch(boxes, tolerance::kEven, 1.1 * extent).extent, 1.1 * extent);
  for (Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) box.max[axis] += 19 * (box.max[axis] - box.min[axis]);
  EXPECT_GT(planSearch(boxes, tolerance::kEven, extent).extent, 1.1 * extent);
}

}  // namespace
}  // namespace yadefrag
