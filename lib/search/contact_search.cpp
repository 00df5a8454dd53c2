#include "search/contact_search.hpp"

#include "curve/numbering.hpp"
#include "search/brute_force.hpp"
#include "search/hierarchy_search.hpp"
#include "search/planned_search.hpp"

namespace yadefrag {
namespace {

template <class Count>
std::unique_ptr<ContactSearch> make(SearchMethod method) {
  switch (method) {
    case SearchMethod::kLebesgue:
      return std::make_unique<PlannedSearch<Count, LebesgueNumbering>>();
    case SearchMethod::kLinearCode:
      return std::make_unique<PlannedSearch<Count, LinearNumbering>>();
    case SearchMethod::kSweptRows:
      return std::make_unique<PlannedSearch<Count, SweptRows>>();
    case SearchMethod::kFastest:
      return std::make_unique<PlannedSearch<Count, LebesgueNumbering, SweptRows>>();
    case SearchMethod::kHierarchy:
      return std::make_unique<HierarchySearch<Count>>();
    case SearchMethod::kBruteForce:
      break;
  }
  return std::make_unique<BruteForce<Count>>();
}

}  // namespace

std::unique_ptr<ContactSearch> makeSearch(SearchMethod method, bool countComparisons) {
  return countComparisons ? make<CountAll>(method) : make<CountNothing>(method);
}

}  // namespace yadefrag
