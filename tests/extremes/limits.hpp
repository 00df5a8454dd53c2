#pragma once
// The manual's table of limits, which the tests check: a test measures the smallest and the largest
// value that works, and docs/limits.md must state the same.

#include <cmath>
#include <string>

#include "core/checks.hpp"

namespace yadefrag::test {

/// There is no such bound: the table shows "–".
inline constexpr double kNone = NAN;

/// The page must have this row, with two digits; a failure shows it. `name` is a literal at the
/// call, and holds the unit.
void limit(const std::string& name, double smallest, double largest, const std::string& beyond);

/// True if the long parts are requested (YADEFRAG_LONG).
bool longRun();

/// Two digits: 10⁻⁹, 3.2·10⁵, 0.02, 47; – for NAN.
std::string numberText(double value);

/// The text of docs/limits.md.
std::string pageOfLimits();

}  // namespace yadefrag::test
