#include "extremes/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace yadefrag::test {
namespace {

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

}  // namespace yadefrag::test
