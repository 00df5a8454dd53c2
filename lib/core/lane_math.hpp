#pragma once
// Logarithm and exponential with the same bits on any processor: those of the C library use fused
// multiplication where the processor has it. Both have a relative error of some 10⁻¹⁵.

#include <bit>
#include <cmath>
#include <cstdint>

namespace yadefrag {

/// log x of a positive, normal number.
inline double logOf(double x) {
  constexpr double kLogTwo = .693147180559945309417;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa > 1.41421356237309504880) mantissa /= 2, ++exponent;
  // log m = 2 artanh y, |y| < 0.172
  const double y = (mantissa - 1) / (mantissa + 1), s = y * y;
  constexpr double kPart[] = {1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13, 1. / 11,
                              1. / 9,  1. / 7,  1. / 5,  1. / 3,  1.};
  double sum = 0;
  for (const double part : kPart) sum = sum * s + part;
  return exponent * kLogTwo + 2 * y * sum;
}

/// exp x for |x| < 700.
inline double expOf(double x) {
  constexpr double kHigh = .693147180369123816490, kLow = 1.90821492927058770002e-10;
  const double whole = std::floor(x * 1.44269504088896340736 + .5);
  const double rest = x - whole * kHigh - whole * kLow;  // |rest| < 0.347
  constexpr double kPart[] = {1. / 6227020800,
                              1. / 479001600,
                              1. / 39916800,
                              1. / 3628800,
                              1. / 362880,
                              1. / 40320,
                              1. / 5040,
                              1. / 720,
                              1. / 120,
                              1. / 24,
                              1. / 6,
                              1. / 2,
                              1.,
                              1.};  // 1/13! to 1/0!
  double sum = 0;
  for (const double part : kPart) sum = sum * rest + part;
  const auto exponent = static_cast<std::uint64_t>(static_cast<int>(whole) + 1023);
  return sum * std::bit_cast<double>(exponent << 52);
}

/// exp x; by a short series near 0.
inline double expOfSmall(double x) {
  if (!(std::abs(x) < .02)) return expOf(x);
  return 1 +
         x * (1 +
              x / 2 * (1 + x * (1. / 3) * (1 + x / 4 * (1 + x * (1. / 5) * (1 + x * (1. / 6))))));
}

/// xʸ for x ≥ 0, y > 0.
inline double powerOf(double x, double y) {
  if (y == 1) return x;
  return x > 0 ? expOf(y * logOf(x)) : 0;
}

}  // namespace yadefrag
