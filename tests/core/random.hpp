#pragma once
// Random numbers of the tests.

#include <random>

namespace yadefrag::test {

using Random = std::mt19937_64;

/// Evenly distributed from `low` to `high`.
inline double even(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace yadefrag::test
