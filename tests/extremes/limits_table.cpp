#include "extremes/limits_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace yadefrag::test {
namespace {

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

}  // namespace

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

}  // namespace yadefrag::test
