#pragma once
// Loops over lanes: the instruction sets for which they are compiled, and functions for them.

#include <bit>
#include <cmath>
#include <cstdint>

namespace yadefrag {

// --- Vector instructions for which some loops are compiled separately.

/// Results have the same bits with each.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

/// The instruction set of this machine for most loops.
inline InstructionSet bestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
}

/// The widest instruction set of this machine, for the loops that gain by it (`runForWide`).
inline InstructionSet widestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx2"))
    return InstructionSet::kAvx512;
#endif
  return bestInstructionSet();
}

/// Runs `work()`, compiled for the instruction set. Its operator must be always inlined.
template <class Work>
auto runBaseline(Work work) {
  return work();
}
#ifdef __x86_64__
template <class Work>
[[gnu::target("avx2")]] auto runAvx2(Work work) {
  return work();
}
// Without the last word GCC would use half of each register.
#ifdef __clang__
#define YADEFRAG_WIDE "avx512f,avx512dq,avx512vl"
#else
#define YADEFRAG_WIDE "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
template <class Work>
[[gnu::target(YADEFRAG_WIDE)]] auto runAvx512(Work work) {
  return work();
}
#undef YADEFRAG_WIDE
#endif

template <class Work>
auto runFor(InstructionSet set, Work work) {
#ifdef __x86_64__
  if (set != InstructionSet::kBaseline) return runAvx2(work);
#endif
  static_cast<void>(set);
  return runBaseline(work);
}

/// Runs `work` with AVX-512 if the set is that, otherwise as `runFor`.
template <class Work>
auto runForWide(InstructionSet set, Work work) {
#ifdef __x86_64__
  if (set == InstructionSet::kAvx512) return runAvx512(work);
#endif
  return runFor(set, work);
}

// --- Logarithm and exponential with the same bits on any processor: those of the C library use
// fused multiplication where the processor has it. Both have a relative error of some 10⁻¹⁵ (logOf
// near 1: of log x itself, too), and have no branch, so that loops over lanes become vector loops.

/// log x of a positive, normal number.
[[gnu::always_inline]] inline double logOf(double x) {
  constexpr double kLogTwo = .693147180559945309417;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // As bits of a number between 2⁵² and 2⁵³, an integer is converted by a subtraction.
  constexpr double kTwo52 = 4503599627370496;
  constexpr auto kBitsOfTwo52 = std::bit_cast<std::uint64_t>(kTwo52);
  double exponent = std::bit_cast<double>((bits >> 52) | kBitsOfTwo52) - (kTwo52 + 1023);
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  const bool isLarge = mantissa > 1.41421356237309504880;
  mantissa = isLarge ? mantissa / 2 : mantissa;
  exponent = isLarge ? exponent + 1 : exponent;
  // log m = 2 artanh y, |y| < 0.172
  const double y = (mantissa - 1) / (mantissa + 1), s = y * y;
  const double s2 = s * s, s4 = s2 * s2;  // pairs of terms do not wait for each other
  const double low = 1 + s * (1. / 3) + (1. / 5 + s * (1. / 7)) * s2;
  const double middle = 1. / 9 + s * (1. / 11) + (1. / 13 + s * (1. / 15)) * s2;
  const double high = 1. / 17 + s * (1. / 19) + (1. / 21) * s2;
  const double sum = low + (middle + high * s4) * s4;
  return exponent * kLogTwo + 2 * y * sum;
}

/// exp x for |x| < 700.
[[gnu::always_inline]] inline double expOf(double x) {
  constexpr double kHigh = .693147180369123816490, kLow = 1.90821492927058770002e-10;
  // Added to 1.5·2⁵², a number is rounded to an integer, which the low bits contain.
  constexpr double kRounding = 6755399441055744;
  const double doublings = x * 1.44269504088896340736 + kRounding;
  const double whole = doublings - kRounding;
  const double r = x - whole * kHigh - whole * kLow, r2 = r * r, r4 = r2 * r2;  // |r| < 0.347
  const double a = 1 + r + (1. / 2 + r * (1. / 6)) * r2;
  const double b = 1. / 24 + r * (1. / 120) + (1. / 720 + r * (1. / 5040)) * r2;
  const double c = 1. / 40320 + r * (1. / 362880) + (1. / 3628800 + r * (1. / 39916800)) * r2;
  const double d = 1. / 479001600 + r * (1. / 6227020800);
  const double sum = a + (b + (c + d * r4) * r4) * r4;
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(doublings) + 1023) << 52;
  return sum * std::bit_cast<double>(exponent);
}

/// exp x for |x| < 0.02; by a short series.
[[gnu::always_inline]] inline double expOfTiny(double x) {
  return 1 +
         x * (1 +
              x / 2 * (1 + x * (1. / 3) * (1 + x / 4 * (1 + x * (1. / 5) * (1 + x * (1. / 6))))));
}

/// exp x; by that series near 0.
inline double expOfSmall(double x) { return std::abs(x) < .02 ? expOfTiny(x) : expOf(x); }

/// xʸ for x ≥ 0, y > 0.
[[gnu::always_inline]] inline double powerOf(double x, double y) {
  const double power = expOf(y * logOf(x));
  return x > 0 ? power : 0;
}

// --- Powers with the bits of std::pow, in half its time.

struct HalfPowers {
  double root;         ///< std::pow(x, .5)
  double threeHalves;  ///< std::pow(x, 1.5)
};

/// a b − p exactly, if p is the rounded product (Dekker 1971, A floating-point technique for
/// extending the available precision, mul12).
[[gnu::always_inline]] inline double errorOfProduct(double a, double b, double p) {
  constexpr double kSplit = 134217729;  // 2²⁷ + 1
  const double a1 = kSplit * a - (kSplit * a - a), a2 = a - a1;
  const double b1 = kSplit * b - (kSplit * b - b), b2 = b - b1;
  return ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
}

/// Both are computed to twice the digits. std::pow rounds a value with an error of at most .04
/// units in the last place (glibc 2.28 and later, e_pow.c): where the exact one is farther than .05
/// units from the middle of two numbers, it returns the nearest, too. Else it is called: for a
/// tenth of all x, and for those that are extreme or no positive numbers.
[[gnu::always_inline]] inline HalfPowers halfPowersOf(double x) {
  if (!(x > 1e-100 && x < 1e100)) return {std::pow(x, .5), std::pow(x, 1.5)};
  const auto isNearest = [](double value, double rest) {
    const auto exponent = std::bit_cast<std::uint64_t>(value) & 0x7ff0000000000000ULL;
    return std::abs(rest) < .45 * 0x1p-52 * std::bit_cast<double>(exponent);
  };
  const double root = std::sqrt(x), square = root * root;
  const double rootRest = ((x - square) - errorOfProduct(root, root, square)) / (2 * root);
  const double product = x * root, low = errorOfProduct(x, root, product) + x * rootRest;
  const double threeHalves = product + low, rest = low - (threeHalves - product);
  return {isNearest(root, rootRest) ? root : std::pow(x, .5),
          isNearest(threeHalves, rest) ? threeHalves : std::pow(x, 1.5)};
}

}  // namespace yadefrag
