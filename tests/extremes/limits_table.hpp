#pragma once
// The table of limits in docs/limits.md.

#include <string>
#include <vector>

namespace yadefrag::test {

struct LimitRow {
  std::string name, smallest, largest, beyond;
};

/// The rows between the page's two marks.
std::vector<LimitRow> readmeLimits();

/// With its line end.
std::string lineOf(const LimitRow& row);

}  // namespace yadefrag::test
