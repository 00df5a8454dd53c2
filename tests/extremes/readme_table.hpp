#pragma once
// The table of limits in the README.

#include <string>
#include <vector>

namespace yadefrag::test {

struct LimitRow {
  std::string name, smallest, largest, beyond;
};

/// The rows between the README's two marks.
std::vector<LimitRow> readmeLimits();

/// With its line end.
std::string lineOf(const LimitRow& row);

}  // namespace yadefrag::test
