// The mechanism of the table of limits itself.

#include "extremes/limits.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace yadefrag::test {
namespace {

TEST(LimitsTable, NumbersAreReadAsTheyAreWritten) {
  const std::pair<double, const char*> numbers[] = {
      {0, "0"},           {0, "0"},       {1, "1"},     {47, "47"},         {.02, "0.02"},
      {1500, "1500"},     {1e-9, "10⁻⁹"}, {1e6, "10⁶"}, {3.2e5, "3.2·10⁵"}, {1e4, "10⁴"},
      {4e-12, "4·10⁻¹²"}, {.5, "0.5"},    {2.5, "2.5"}, {100, "100"},       {.015, "0.015"},
      {INFINITY, "∞"},    {9.96e3, "10⁴"}};
  for (const auto& [value, text] : numbers) {
    EXPECT_EQ(numberText(value), text);
    EXPECT_TRUE(numberOf(text) == value || std::abs(numberOf(text) / value - 1) < .005) << text;
  }
  EXPECT_EQ(numberText(kNone), "–");
  for (const char* text : {"", "–", "5⁶", "10⁻", "ten", "3·10⁵ m"})
    EXPECT_TRUE(std::isnan(numberOf(text))) << text;
}

/// The first argument of each call of `limit`, which may stand on the next line.
void addNames(const std::string& text, std::set<std::string>& names) {
  const std::string call = std::string("limit") + '(';  // not to find itself
  for (std::size_t at = text.find(call); at != std::string::npos; at = text.find(call, at)) {
    at = text.find_first_not_of(" \n", at + call.size());
    if (at == std::string::npos || text[at] != '"') continue;
    names.insert(text.substr(at + 1, text.find('"', at + 1) - at - 1));
  }
}

/// A row whose test has gone would never be checked again.
TEST(LimitsTable, EveryRowIsMadeByATest) {
  std::set<std::string> made;
  for (const char* folder : {"extremes", "validation/mechanics"})
    for (const auto& file :
         std::filesystem::directory_iterator(YADEFRAG_ROOT "/tests/" + std::string(folder))) {
      if (file.path().extension() != ".cpp") continue;
      std::ifstream in(file.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      addNames(text, made);
    }
  std::set<std::string> stated;
  for (const LimitRow& row : readmeLimits())
    EXPECT_TRUE(stated.insert(row.name).second) << row.name;
  EXPECT_EQ(stated, made);
}

}  // namespace
}  // namespace yadefrag::test
