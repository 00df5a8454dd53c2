// Vector loops: four values at once, and functions of the C library.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <new>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/checks.hpp"
#include "core/four_lanes.hpp"
#include "core/lanes.hpp"
#include "core/parallel.hpp"

namespace yadefrag::test {
namespace {

using Four = std::array<double, 4>;

struct Results {
  Four cross, product;
  double dot, norm, squaredNormOfFour;
};

Results byLanes(InstructionSet set, const Four& a, const Four& b) {
  Results results;
  runFor(
      set, [&]() __attribute__((always_inline)) {
        const FourLanes one = loadFour(a.data()), two = loadFour(b.data());
        storeFour(cross(one, two), results.cross.data());
        storeFour(quaternionProduct(one, two), results.product.data());
        results.dot = dot(one, two);
        results.norm = norm(one);
        results.squaredNormOfFour = squaredNormOfFour(one);
      });
  return results;
}

// By the formulas of Eigen without vectors, component by component.
Results byComponents(const Four& a, const Four& b) {
  const auto& [ax, ay, az, aw] = a;
  const auto& [bx, by, bz, bw] = b;
  Results results;
  results.cross = {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx, 0};
  results.product = {aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
                     aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz};
  results.dot = ax * bx + (ay * by + az * bz);
  results.norm = std::sqrt(ax * ax + (ay * ay + az * az));
  results.squaredNormOfFour = (ax * ax + ay * ay) + (az * az + aw * aw);
  return results;
}

TEST(FourLanes, HaveTheBitsOfComponents) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> anyValue(0, 3);
  for (int i = 0; i < 2000; ++i) {
    Four a, b;
    for (double& value : a) value = anyValue(random);
    for (double& value : b) value = anyValue(random);
    const Results components = byComponents(a, b);
    for (const InstructionSet set : {InstructionSet::kBaseline, bestInstructionSet()}) {
      const Results lanes = byLanes(set, a, b);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(lanes.cross[k], components.cross[k]);
      EXPECT_EQ(lanes.product, components.product);
      EXPECT_EQ(lanes.dot, components.dot);
      EXPECT_EQ(lanes.norm, components.norm);
      EXPECT_EQ(lanes.squaredNormOfFour, components.squaredNormOfFour);
    }
  }
}

TEST(FourLanes, ThreeLeavesTheFourthValue) {
  Four stored = {1, 2, 3, 4};
  storeThree(loadThree(stored.data()) * 2., stored.data());
  EXPECT_EQ(stored, (Four{2, 4, 6, 4}));
}

// --- Logarithm, exponential and power of the vector loops, compared with the C library's in long
// double over their whole ranges.

constexpr int kCount = 200000;

double errorOf(double found, long double right) {
  return static_cast<double>(std::abs((static_cast<long double>(found) - right) / right));
}

/// The largest one of many draws.
template <class Draw>
double worstOf(Draw errorOfDraw) {
  Random random(1);
  double most = 0;
  for (int i = 0; i < kCount; ++i) most = std::max(most, errorOfDraw(random));
  return most;
}

TEST(LaneMath, HasTheRoundingOfTheCLibrary) {
  using Long = long double;
  constexpr double kMost = 1e-15;
  const auto logarithm = [](double x) { return errorOf(logOf(x), std::log(static_cast<Long>(x))); };
  EXPECT_LT(worstOf([&](Random& random) {
              const int exponent = static_cast<int>(even(random, -1022, 1023));
              return logarithm(std::ldexp(even(random, 1, 2), exponent));
            }),
            kMost);
  EXPECT_LT(worstOf([&](Random& random) {
              const double near = std::exp(even(random, -30, -1));
              return std::max(logarithm(1 + near), logarithm(1 - near / 2));
            }),
            kMost);
  EXPECT_LT(worstOf([](Random& random) {
              const double x = even(random, -700, 700), tiny = even(random, -.02, .02);
              return std::max(errorOf(expOf(x), std::exp(static_cast<Long>(x))),
                              errorOf(expOfTiny(tiny), std::exp(static_cast<Long>(tiny))));
            }),
            kMost);
  // The error of y log x is one of the power: 10⁻¹⁵ times its size.
  EXPECT_LT(worstOf([](Random& random) {
              const double x = std::exp(even(random, -30, 30)), y = even(random, .01, 3);
              const Long right = std::pow(static_cast<Long>(x), static_cast<Long>(y));
              return errorOf(powerOf(x, y), right) / (1 + std::abs(y * std::log(x)));
            }),
            kMost);
  EXPECT_EQ(logOf(1), 0);
  EXPECT_EQ(expOf(0), 1);
  EXPECT_EQ(powerOf(0, .3), 0);
}

TEST(LaneMath, HalfPowersHaveTheBitsOfPow) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponents(-110, 110);
  std::vector<double> all{0., -0., -1., 5e-324, 1e-320, 1e-100, 1., 2., 4., 1e100, 1e300, INFINITY};
  for (int i = 0; i < 200000; ++i) all.push_back(std::pow(10, exponents(random)));
  for (int i = 0; i < 1000; ++i) {  // squares, cubes and their neighbours: exact or nearly so
    const double whole = 1 + i;
    for (const double x : {whole * whole, std::nextafter(whole * whole, 0.)}) all.push_back(x);
  }
  for (const double x : all) {
    const HalfPowers powers = halfPowersOf(x);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(powers.root),
              std::bit_cast<std::uint64_t>(std::pow(x, .5)))
        << x;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(powers.threeHalves),
              std::bit_cast<std::uint64_t>(std::pow(x, 1.5)))
        << x;
  }
  EXPECT_TRUE(std::isnan(halfPowersOf(NAN).root) && std::isnan(halfPowersOf(NAN).threeHalves));
}

constexpr std::size_t kManyItems = 8 * tolerance::kMinItemsPerThread;

/// Each item is done once. Memory may run out in any thread.
TEST(Parallel, PartsCoverTheRangeAndErrorsReachTheCaller) {
  for (const int threads : {1, 2, 3, 8}) {
    SCOPED_TRACE(threads);
    std::vector<int> seen(kManyItems), done(1000);
    const int parts =
        forEachPart(kManyItems, threads, [&](std::size_t begin, std::size_t end, int) {
          for (std::size_t i = begin; i < end; ++i) ++seen[i];
        });
    EXPECT_EQ(parts, threads);
    EXPECT_EQ(seen, std::vector<int>(kManyItems, 1));
    forEachItem(done.size(), kManyItems, threads, [&](std::size_t item) { ++done[item]; });
    EXPECT_EQ(done, std::vector<int>(1000, 1));
    const auto fail = [](auto...) { throw std::bad_alloc(); };
    EXPECT_THROW(forEachPart(kManyItems, threads, fail), std::bad_alloc);
    EXPECT_THROW(forEachItem(1000, kManyItems, threads, fail), std::bad_alloc);
  }
}

TEST(Parallel, FewItemsRunOnThreadsIfTestsWantIt) {
  const auto partsOfTen = [] { return forEachPart(10, 3, [](std::size_t, std::size_t, int) {}); };
  {
    const ThreadsForFew few(3);
    EXPECT_EQ(partsOfTen(), 3);
  }
  EXPECT_EQ(partsOfTen(), 1);
}

TEST(Parallel, TheFirstPartsErrorIsThrownAfterAllHaveEnded) {
  std::atomic<int> ended = 0;
  try {
    forEachPart(kManyItems, 4, [&](std::size_t, std::size_t, int part) {
      ++ended;
      if (part % 2 == 1) throw std::runtime_error(std::to_string(part));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "1");
  }
  EXPECT_EQ(ended, 4);
}

}  // namespace
}  // namespace yadefrag::test
