#include "search/contact_search.hpp"

#include "search/hierarchy_search.hpp"
#include "search/numbering.hpp"
#include "search/planned_search.hpp"

namespace yadefrag {
namespace {

/// Tests every box against every other: the reference for all other searches.
class BruteForce final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    boxes_ = boxes;
  }
  void relocate(std::span<const Box> boxes) override { boxes_ = boxes; }
  void clear() override { boxes_ = {}; }

  void findPairs(std::vector<BoxPair>& pairs) override {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes_.size(); ++j) {
        count_.test(6);
        if (overlaps(boxes_[i], boxes_[j])) pairs.push_back({BoxId(i), BoxId(j)});
      }
      if (isFull(pairs)) throw TooManyPairs();
    }
  }

  void findOverlaps(const Box& box, std::vector<BoxId>& found) const override {
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (overlaps(box, boxes_[i])) found.push_back(BoxId(i));
  }

 private:
  std::span<const Box> boxes_;
};

std::unique_ptr<ContactSearch> make(SearchMethod method) {
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

}  // namespace

std::unique_ptr<ContactSearch> makeSearch(SearchMethod method, bool countComparisons) {
  std::unique_ptr<ContactSearch> search = make(method);
  search->setCounting(countComparisons);
  return search;
}

}  // namespace yadefrag
