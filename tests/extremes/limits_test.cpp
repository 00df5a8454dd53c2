// The mechanism of the table of limits itself.

#include "extremes/limits.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace yadefrag::test {
namespace {

TEST(LimitsTable, NumbersHaveTwoDigits) {
  const std::pair<double, const char*> numbers[] = {
      {0, "0"},       {1, "1"},           {47, "47"},      {.02, "0.02"},
      {1500, "1500"}, {1e-9, "10⁻⁹"},     {1e6, "10⁶"},    {3.2e5, "3.2·10⁵"},
      {1e4, "10⁴"},   {4e-12, "4·10⁻¹²"}, {.5, "0.5"},     {2.5, "2.5"},
      {100, "100"},   {.015, "0.015"},    {9.96e3, "10⁴"}, {kNone, "–"}};
  for (const auto& [value, text] : numbers) EXPECT_EQ(numberText(value), text);
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
  std::istringstream page(pageOfLimits());
  std::set<std::string> stated;
  bool isTable = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| what | smallest |")) isTable = true;
    if (!isTable || !line.starts_with("| ") || line.starts_with("| what ")) continue;
    const std::string name = line.substr(2, line.find(" | ") - 2);
    EXPECT_TRUE(stated.insert(name).second) << name;
  }
  EXPECT_EQ(stated, made);
}

}  // namespace
}  // namespace yadefrag::test
