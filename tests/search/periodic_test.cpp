// Pairs in a periodic cell against all 27 copies of every box.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/errors.hpp"
#include "search/contact_search.hpp"
#include "search/periodic.hpp"

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

// --- Nearest copies in sheared cells against brute force over many images.

using Periods = std::array<Lattice::Vector, 3>;

double lengthOf(Lattice::Vector v, const Periods& periods, const Lattice::Cells& cells) {
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) v[axis] += cells[i] * periods[i][axis];
  return std::hypot(v[0], v[1], v[2]);
}

/// The least distance over all shifts of up to `most` cells.
double leastOf(const Lattice::Vector& v, const Periods& periods, int most) {
  double least = INFINITY;
  for (int i = -most; i <= most; ++i)
    for (int j = -most; j <= most; ++j)
      for (int k = -most; k <= most; ++k) least = std::min(least, lengthOf(v, periods, {i, j, k}));
  return least;
}

class RandomCell {
 public:
  explicit RandomCell(std::uint64_t seed) : random_(seed) {}

  /// Any cell, or one with edges along the axes and any shear up to `shear`.
  Periods periods(double shear) {
    Periods out{};
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis)
        out[i][axis] = shear == 0 || i > axis ? uniform(1) * (shear > 0 ? shear : 1) : 0;
    for (int i = 0; i < 3; ++i)
      if (shear > 0) out[i][i] = .6 + std::abs(uniform(.5));
    return out;
  }
  Lattice::Vector point(const Periods& periods) {
    Lattice::Vector out{};
    for (const Lattice::Vector& period : periods) {
      const double times = uniform(1.5);
      for (int axis = 0; axis < 3; ++axis) out[axis] += times * period[axis];
    }
    return out;
  }

 private:
  double uniform(double most) {
    return std::uniform_real_distribution<double>(-most, most)(random_);
  }
  std::mt19937_64 random_;
};

TEST(Lattice, NearestCopyAsOfManyImages) {
  int cells = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomCell random(seed);
    const double shear = seed % 4 ? 2. * static_cast<double>(seed % 4) : 0;
    const Periods periods = random.periods(shear);
    const Lattice lattice(periods);
    // Twice the shear of one axis leads through another's: the images needed lie within the square.
    const auto most = static_cast<int>(std::ceil(2 * lattice.reach()[0] + 2 * lattice.reach()[1] +
                                                 2 * lattice.reach()[2])) +
                      3;
    if (most > 30) continue;
    ++cells;
    for (int i = 0; i < 3; ++i) {
      const Lattice::Vector point = random.point(periods);
      const Lattice::Cells shift = lattice.nearest(point);
      const double least = leastOf(point, periods, most);
      ASSERT_NEAR(lengthOf(point, periods, shift), least, 1e-12 * (1 + least)) << "seed " << seed;
    }
  }
  EXPECT_GT(cells, 200);
}

TEST(Lattice, ShortestPeriodOfManyImages) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Periods periods = RandomCell(seed).periods(6);
    const Lattice lattice(periods);
    double least = INFINITY;
    for (int i = -80; i <= 80; ++i)
      for (int j = -12; j <= 12; ++j)
        for (int k = -2; k <= 2; ++k)
          if (i || j || k) least = std::min(least, lengthOf({}, periods, {i, j, k}));
    ASSERT_NEAR(lattice.shortest(), least, 1e-12) << "seed " << seed;
  }
}

TEST(Lattice, SevenCellsAway) {
  const Lattice lattice({{{1, 0, 0}, {7.2, 1, 0}, {0, 0, 1}}});
  EXPECT_NEAR(lattice.shortest(), 1, 1e-12);
  EXPECT_EQ(lattice.nearest({.2, .95, 0}), (Lattice::Cells{7, -1, 0}));
  EXPECT_EQ(lattice.nearest({.2, .1, 0}), (Lattice::Cells{0, 0, 0}));
}

TEST(Lattice, RefusesWhatIsNoCell) {
  EXPECT_THROW(Lattice({{{1, 0, 0}, {2, 0, 0}, {0, 0, 1}}}), InputError);
  EXPECT_THROW(Lattice({{{1, 0, 0}, {0, NAN, 0}, {0, 0, 1}}}), InputError);
  EXPECT_THROW(Lattice({{{1, 0, 0}, {1e8, 1, 0}, {0, 0, 1}}}), InputError);
}

}  // namespace
}  // namespace yadefrag
