// Pairs in a periodic cell against all 27 copies of every box.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "search/contact_search.hpp"
#include "search/periodic_images.hpp"
#include "search/periodic_overlap.hpp"

namespace yadefrag {
namespace {

using Size = std::array<double, 3>;
using Shift = std::array<int, 3>;

struct Cell {
  std::mt19937_64 random;
  Size size{};
  std::vector<Box> boxes;

  explicit Cell(std::uint64_t seed) : random(seed) {
    std::uniform_real_distribution<double> unit(0, 1);
    for (double& edge : size) edge = .5 + unit(random);
    const std::size_t count = random() % 40;
    for (std::size_t i = 0; i < count; ++i) {
      Box box;
      for (int axis = 0; axis < 3; ++axis) {
        // Anywhere, several cells away too; up to 49 % of the cell long.
        const double low = size[axis] * (6 * unit(random) - 3);
        box.min[axis] = low;
        box.max[axis] = low + size[axis] * .49 * unit(random) * unit(random);
      }
      boxes.push_back(box);
    }
  }
};

/// All shifts of b, by whole cells, with which it overlaps a.
std::vector<Shift> shiftsThatOverlap(const Box& a, const Box& b, const Size& size) {
  std::array<std::vector<int>, 3> onAxis;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = -9; k <= 9; ++k)
      if (a.min[axis] <= b.max[axis] + k * size[axis] &&
          b.min[axis] + k * size[axis] <= a.max[axis])
        onAxis[axis].push_back(k);
  std::vector<Shift> all;
  for (const int x : onAxis[0])
    for (const int y : onAxis[1])
      for (const int z : onAxis[2]) all.push_back({x, y, z});
  return all;
}

TEST(Periodic, PairsAndShiftsAsOfAllCopies) {
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const Cell cell(seed);
    std::map<BoxPair, Shift> expected;
    for (std::size_t i = 0; i < cell.boxes.size(); ++i)
      for (std::size_t j = i + 1; j < cell.boxes.size(); ++j) {
        const auto shifts = shiftsThatOverlap(cell.boxes[i], cell.boxes[j], cell.size);
        ASSERT_LE(shifts.size(), 1U);
        if (!shifts.empty()) expected[{BoxId(i), BoxId(j)}] = shifts.front();
      }
    PeriodicImages images;
    images.build(cell.boxes, cell.size, 1e-7);
    const auto search = makeSearch(SearchMethod::kLebesgue);
    std::vector<BoxPair> pairs;
    search->update(images.boxes());
    search->findPairs(pairs);
    images.toSlots(pairs);
    std::map<BoxPair, Shift> got;
    for (const BoxPair& pair : pairs) {
      const PeriodicOverlap meets = periodicOverlap(
          cell.boxes[pair.first.value], cell.boxes[pair.second.value], {cell.size, 1e-12, false});
      if (meets.kind == PeriodicOverlap::kOverlap) got[pair] = meets.shift;
      ASSERT_NE(meets.kind, PeriodicOverlap::kTooLarge);
    }
    ASSERT_EQ(got, expected) << "seed " << seed;
    found += got.size();
  }
  EXPECT_GT(found, 15000U);
}

TEST(Periodic, LimitsOfSize) {
  const Size size = {1, 1, 1};
  const Box small = {{0, 0, 0}, {.1, .1, .1}};
  const Box large = {{0, 0, 0}, {.1, .6, .1}};
  const PeriodicRules strict{size, 1e-7, false};
  const PeriodicOverlap meets = periodicOverlap(small, large, strict);
  EXPECT_EQ(meets.kind, PeriodicOverlap::kTooLarge);
  EXPECT_EQ(meets.axis, 1);
  EXPECT_TRUE(meets.secondTooLarge);
  // As the first of a pair a box may fill up to the whole cell.
  EXPECT_EQ(periodicOverlap(large, small, strict).kind, PeriodicOverlap::kOverlap);
  const Box longer = {{0, 0, 0}, {.1, 1.1, .1}};
  EXPECT_EQ(periodicOverlap(longer, small, strict).kind, PeriodicOverlap::kTooLarge);
  EXPECT_FALSE(periodicOverlap(longer, small, strict).secondTooLarge);

  const PeriodicRules lenient{size, 1e-7, true};
  const Box far = {{.05, 7.3, .05}, {.1, 7.4, .1}};
  const PeriodicOverlap along = periodicOverlap(far, longer, lenient);
  EXPECT_EQ(along.kind, PeriodicOverlap::kOverlap);
  EXPECT_EQ(along.shift, (Shift{0, 0, 0}));
}

TEST(Periodic, NoBoxesAndAbsentOnes) {
  PeriodicImages images;
  images.build({}, {1, 1, 1}, 0);
  EXPECT_TRUE(images.boxes().empty());
  const std::vector<Box> boxes = {Box::absent()};
  images.build(boxes, {1, 1, 1}, 0);
  EXPECT_EQ(images.boxes().size(), 1U);
  EXPECT_EQ(images.span()[0], 0);
}

}  // namespace
}  // namespace yadefrag
