#pragma once
// Overlapping pairs of boxes for a single query: no data are kept for later queries.

#include <memory>
#include <span>
#include <vector>

#include "search/contact_search.hpp"

namespace yadefrag {

[[nodiscard]] inline std::vector<BoxPair> overlappingPairs(
    std::span<const Box> boxes, int threads = 1, SearchMethod method = SearchMethod::kLebesgue) {
  const std::unique_ptr<ContactSearch> search = makeSearch(method);
  search->setThreads(threads);
  search->update(boxes);
  std::vector<BoxPair> pairs;
  search->findPairs(pairs);
  return pairs;
}

}  // namespace yadefrag
