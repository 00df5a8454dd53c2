#pragma once
// All softening curves that a material can have, for tests.

#include <string>
#include <utility>
#include <vector>

#include "mesh/softening_curve.hpp"

namespace yadefrag::test {

/// The named ones, and tables: a plateau before a steep fall, a step, uneven points.
inline std::vector<std::pair<std::string, SofteningCurve>> softeningCurves() {
  std::vector<std::pair<std::string, SofteningCurve>> all;
  for (const std::string_view name : softeningNames()) all.emplace_back(name, softeningNamed(name));
  all.emplace_back("plateau", SofteningCurve({{0, 1}, {.6, 1}, {1, 0}}));
  all.emplace_back("step", SofteningCurve({{0, 1}, {.1, .9}, {.2, .3}, {.7, .3}, {1, 0}}));
  all.emplace_back("uneven", SofteningCurve({{0, 1}, {.01, .8}, {.3, .25}, {.9, .2}, {1, 0}}));
  return all;
}

}  // namespace yadefrag::test
