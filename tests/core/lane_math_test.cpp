// Logarithm, exponential and power of the vector loops, compared with the C library's in long
// double over their whole ranges.

#include "core/lane_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace yadefrag::test {
namespace {

constexpr int kCount = 200000;

double errorOf(double found, long double right) {
  return static_cast<double>(std::abs((static_cast<long double>(found) - right) / right));
}

TEST(LaneMath, LogarithmOfAllNormalNumbers) {
  Random random(1);
  double most = 0, mostNearOne = 0;
  for (int i = 0; i < kCount; ++i) {
    const double exponent = even(random, -1022, 1023), mantissa = even(random, 1, 2);
    const double x = std::ldexp(mantissa, static_cast<int>(exponent));
    most = std::max(most, errorOf(logOf(x), std::log(static_cast<long double>(x))));
    const double near = 1 + std::exp(even(random, -30, -1)) * (i % 2 == 0 ? 1 : -.5);
    mostNearOne =
        std::max(mostNearOne, errorOf(logOf(near), std::log(static_cast<long double>(near))));
  }
  EXPECT_EQ(logOf(1), 0);
  EXPECT_LT(most, 1e-15);
  EXPECT_LT(mostNearOne, 1e-15);
}

TEST(LaneMath, ExponentialFromTheLeastToTheLargestNumber) {
  Random random(2);
  double most = 0, mostTiny = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = even(random, -700, 700), tiny = even(random, -.02, .02);
    most = std::max(most, errorOf(expOf(x), std::exp(static_cast<long double>(x))));
    mostTiny =
        std::max(mostTiny, errorOf(expOfTiny(tiny), std::exp(static_cast<long double>(tiny))));
  }
  EXPECT_EQ(expOf(0), 1);
  EXPECT_LT(most, 1e-15);
  EXPECT_LT(mostTiny, 1e-15);
}

// The error of y log x is one of the power: 10⁻¹⁵ times its size.
TEST(LaneMath, Powers) {
  Random random(3);
  double most = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = std::exp(even(random, -30, 30)), y = even(random, .01, 3);
    const long double right = std::pow(static_cast<long double>(x), static_cast<long double>(y));
    const double size = std::abs(y * std::log(x));
    most = std::max(most, errorOf(powerOf(x, y), right) / (1 + size));
  }
  EXPECT_LT(most, 1e-15);
  EXPECT_EQ(powerOf(0, .3), 0);
}

}  // namespace
}  // namespace yadefrag::test
