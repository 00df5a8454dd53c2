#include "search/contact_search.hpp"

#include "curve/numbering.hpp"
#include "search/brute_force.hpp"
#include "search/hierarchy_search.hpp"
#include "search/planned_search.hpp"

namespace yadefrag {
std::unique_ptr<ContactSearch> makeSearch(SearchMethod method) {
  switch (method) {
    case SearchMethod::kLebesgue:
      return std::make_unique<PlannedSearch<LebesgueNumbering>>();
    case SearchMethod::kLinearCode:
      return std::make_unique<PlannedSearch<LinearNumbering>>();
    case SearchMethod::kSweptRows:
      return std::make_unique<PlannedSearch<SweptRows>>();
    case SearchMethod::kFastest:
      return std::make_unique<PlannedSearch<LebesgueNumbering, SweptRows>>();
    case SearchMethod::kHierarchy:
      return std::make_unique<HierarchySearch>();
    case SearchMethod::kBruteForce:
      break;
  }
  return std::make_unique<BruteForce>();
}

}  // namespace yadefrag
