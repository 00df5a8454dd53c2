#include "figure14/point_search.hpp"

#include <utility>

#include "figure14/point_brute_force.hpp"
#include "figure14/point_code_search.hpp"
#include "figure14/point_hierarchy.hpp"

namespace yadefrag {
namespace {

template <class Numbering, Lookup kLookup, class Count>
std::unique_ptr<PointSearch> makeCodes(const PointSearchPlan& plan) {
  return std::make_unique<PointCodeSearch<Numbering, kLookup, Count>>(plan);
}

template <class Count>
std::unique_ptr<PointSearch> make(SearchMethod method, PointSearchPlan plan) {
  switch (method) {
    case SearchMethod::kLebesgue:
      if (plan.directory) return makeCodes<LebesgueNumbering<2>, Lookup::kDirectory, Count>(plan);
      return makeCodes<LebesgueNumbering<2>, Lookup::kExponential, Count>(plan);
    case SearchMethod::kLinearCode:
      return makeCodes<LinearNumbering<2>, Lookup::kBinary, Count>(plan);
    case SearchMethod::kHierarchy:
      return std::make_unique<PointHierarchySearch<Count>>(std::move(plan));
    case SearchMethod::kSweptRows:  // these two search boxes only
    case SearchMethod::kFastest:
    case SearchMethod::kBruteForce:
      break;
  }
  return std::make_unique<PointBruteForce<Count>>();
}

}  // namespace

std::unique_ptr<PointSearch> makePointSearch(SearchMethod method, PointSearchPlan plan,
                                             bool countComparisons) {
  return countComparisons ? make<CountAll>(method, std::move(plan))
                          : make<CountNothing>(method, std::move(plan));
}

}  // namespace yadefrag
