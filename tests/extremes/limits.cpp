#include "extremes/limits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

namespace yadefrag::test {
namespace {

// --- numbers

const std::string kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
const std::string kRaisedMinus = "⁻", kTimes = "·";

std::string raised(int exponent) {
  std::string text = exponent < 0 ? kRaisedMinus : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kRaised[digit - '0'];
  return text;
}

/// Takes a raised digit or sign from the end of `text`: its plain form, or 0.
char takeRaised(std::string& text) {
  const auto takes = [&](const std::string& end) {
    if (!text.ends_with(end)) return false;
    text.erase(text.size() - end.size());
    return true;
  };
  if (takes(kRaisedMinus)) return '-';
  for (int digit = 0; digit < 10; ++digit)
    if (takes(kRaised[digit])) return static_cast<char>('0' + digit);
  return 0;
}

double plainNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != 0 ? NAN : value;
}

// --- the page's table

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::string limitsOfReadme() {
  std::ifstream in(YADEFRAG_ROOT "/docs/limits.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto begin = text.find("<!-- limits");
  const auto end = text.find("<!-- end of limits -->");
  if (begin < end && end != std::string::npos) return text.substr(begin, end - begin);
  ADD_FAILURE() << "docs/limits.md lacks the marks of its table of limits";
  return {};
}

void expectNear(const std::string& what, double measured, const std::string& stated,
                double factor) {
  if (!std::isfinite(measured)) {
    EXPECT_EQ(stated, numberText(measured)) << what;
    return;
  }
  const double value = numberOf(stated);
  EXPECT_TRUE(measured == value || std::abs(std::log(measured / value)) <= std::log(factor))
      << what << ": docs/limits.md states " << stated << ", measured " << measured
      << "; scripts/bench limits rewrites it";
}

}  // namespace

std::string numberText(double value) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
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
  return (mantissa == "1" ? "" : mantissa + kTimes) + "10" + raised(exponent);
}

double numberOf(const std::string& text) {
  if (text == "∞") return INFINITY;
  std::string mantissa = text, exponent;
  for (char digit = 0; (digit = takeRaised(mantissa)) != 0;) exponent.insert(0, 1, digit);
  if (exponent.empty()) return plainNumber(text);
  if (!mantissa.ends_with("10")) return NAN;
  mantissa.erase(mantissa.size() - 2);
  if (mantissa.ends_with(kTimes)) mantissa.erase(mantissa.size() - kTimes.size());
  return plainNumber((mantissa.empty() ? "1" : mantissa) + "e" + exponent);
}

std::vector<LimitRow> readmeLimits() {
  std::istringstream lines(limitsOfReadme());
  std::vector<LimitRow> rows;
  int header = 2;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('|') || header-- > 0) continue;
    std::vector<std::string> cells;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
    cells.resize(4);
    rows.push_back({cells[0], cells[1], cells[2], cells[3]});
  }
  return rows;
}

std::string lineOf(const LimitRow& row) {
  return "| " + row.name + " | " + row.smallest + " | " + row.largest + " | " + row.beyond + " |\n";
}

void limit(const std::string& name, double smallest, double largest, const std::string& beyond,
           double factor) {
  const LimitRow row{name, numberText(smallest), numberText(largest), beyond};
  if (const char* folder = std::getenv("YADEFRAG_LIMITS")) {
    // One file a row: the tests may run in several processes at once.
    const std::size_t hash = std::hash<std::string>()(name);
    std::ofstream(std::string(folder) + "/" + std::to_string(hash) + ".row") << lineOf(row);
    return;
  }
  for (const LimitRow& stated : readmeLimits()) {
    if (stated.name != name) continue;
    expectNear(name + ", smallest", smallest, stated.smallest, factor);
    expectNear(name + ", largest", largest, stated.largest, factor);
    EXPECT_EQ(stated.beyond, beyond) << name;
    return;
  }
  ADD_FAILURE() << "docs/limits.md has no row for\n"
                << lineOf(row) << "scripts/bench limits adds it";
}

bool longRun() { return std::getenv("YADEFRAG_LONG") != nullptr; }

}  // namespace yadefrag::test
