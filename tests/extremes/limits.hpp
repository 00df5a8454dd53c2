#pragma once
// The manual's table of limits, which the tests make and check: a test measures the smallest and
// the largest value that works, and docs/limits.md must state the same.

#include <cmath>
#include <string>
#include <vector>

#include "core/sentence.hpp"

namespace yadefrag::test {

/// There is no such bound: the table shows "–".
inline constexpr double kNone = NAN;

/// One row. The page's row of this name has to have the same sentence, and numbers that are equal
/// but for a factor: the default is that of rounding to two digits, larger ones are for measured
/// figures that depend on rounding. `name` is a literal at the call, and holds the unit. With
/// YADEFRAG_LIMITS=folder the row is written there instead, for scripts/bench limits.
void limit(const std::string& name, double smallest, double largest, const std::string& beyond,
           double factor = 1.06);

/// True if the long parts are requested (YADEFRAG_LONG).
bool longRun();

/// Two digits: 10⁻⁹, 3.2·10⁵, 0.02, 47; – for NAN, ∞.
std::string numberText(double value);

/// The reverse; NAN for what is no number.
double numberOf(const std::string& text);

struct LimitRow {
  std::string name, smallest, largest, beyond;
};

/// The rows between the page's two marks.
std::vector<LimitRow> readmeLimits();

/// With its line end.
std::string lineOf(const LimitRow& row);

}  // namespace yadefrag::test
