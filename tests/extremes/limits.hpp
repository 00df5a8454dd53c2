#pragma once
// The manual's table of limits, which the tests check: a test measures the smallest and the largest
// value that works, and docs/limits.md must state the same.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "core/checks.hpp"

namespace yadefrag::test {

/// There is no such bound: the table shows "–".
inline constexpr double kNone = NAN;

/// Of a power of ten.
inline std::string raised(int exponent) {
  static const std::string kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[digit - '0'];
  return text;
}

/// Two digits: 10⁻⁹, 3.2·10⁵, 0.02, 47; – for NAN.
inline std::string numberText(double value) {
  if (std::isnan(value)) return "–";
  char text[40];
  std::snprintf(text, sizeof text, "%.1e", value);
  const std::string scientific(text);
  const auto e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent >= -2 && exponent <= 3) {
    std::snprintf(text, sizeof text, "%.*f", std::max(0, 1 - exponent), std::stod(scientific));
    std::string plain(text);
    if (plain.find('.') != std::string::npos) {
      plain.erase(plain.find_last_not_of('0') + 1);
      if (plain.back() == '.') plain.pop_back();
    }
    return plain;
  }
  std::string mantissa = scientific.substr(0, e);
  if (mantissa.ends_with(".0")) mantissa.erase(mantissa.size() - 2);
  return (mantissa == "1" ? "" : mantissa + "·") + "10" + raised(exponent);
}

/// The text of docs/limits.md.
inline std::string pageOfLimits() {
  std::ifstream in(YADEFRAG_ROOT "/docs/limits.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The page must have this row, with two digits; a failure shows it. `name` is a literal at the
/// call, and holds the unit.
inline void limit(const std::string& name, double smallest, double largest,
                  const std::string& beyond) {
  const std::string row = "| " + name + " | " + numberText(smallest) + " | " + numberText(largest) +
                          " | " + beyond + " |\n";
  EXPECT_NE(pageOfLimits().find(row), std::string::npos) << "docs/limits.md has no row\n" << row;
}

/// True if the long parts are requested (YADEFRAG_LONG).
inline bool longRun() { return std::getenv("YADEFRAG_LONG") != nullptr; }

}  // namespace yadefrag::test
