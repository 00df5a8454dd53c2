#include "extremes/limits.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "extremes/limits_table.hpp"
#include "extremes/number_text.hpp"

namespace yadefrag::test {
namespace {

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

void expectSentence(const std::string& text) {
  EXPECT_GE(std::count(text.begin(), text.end(), ' '), 4) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with('.')) << text;
}

}  // namespace yadefrag::test
