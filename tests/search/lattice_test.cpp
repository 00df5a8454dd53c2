// Nearest copies in sheared cells against brute force over many images.
#include "search/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

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
