// Our own searches, in the form for the comparison.
#include <algorithm>
#include <memory>

#include "benchmark/rivals/rival.hpp"
#include "search/incremental_search.hpp"

namespace yadefrag {
namespace {

/// A search that looks at all boxes each time.
class Whole final : public Rival {
 public:
  Whole(SearchMethod method, int threads) : search_(makeSearch(method)) {
    search_->setThreads(threads);
  }
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    search_->update(boxes_);
  }
  void update(std::span<const BoxId> /*changed*/) override { search_->update(boxes_); }
  void findPairs(std::vector<BoxPair>& pairs) override { search_->findPairs(pairs); }

 private:
  std::unique_ptr<ContactSearch> search_;
  std::span<const Box> boxes_;
};

/// The search with a list of changed boxes, and the list of pairs that its caller keeps.
class MovedGiven final : public Rival {
 public:
  explicit MovedGiven(int threads) : search_(SearchMethod::kLebesgue) {
    search_.setThreads(threads);
  }
  void build(std::span<const Box> boxes) override {
    boxes_ = boxes;
    hasChanged_.assign(boxes.size(), false);
    search_.update(boxes);
    search_.findPairs(kept_);
  }
  /// From a tenth of the boxes on it is cheaper to look at all.
  void update(std::span<const BoxId> changed) override {
    if (changed.size() * 10 > boxes_.size()) {
      search_.update(boxes_);
      kept_.clear();
      search_.findPairs(kept_);
      return;
    }
    for (const BoxId id : changed) hasChanged_[id.value] = true;
    std::erase_if(kept_, [&](const BoxPair& pair) {
      return hasChanged_[pair.first.value] || hasChanged_[pair.second.value];
    });
    for (const BoxId id : changed) hasChanged_[id.value] = false;
    search_.change(boxes_, changed);
    search_.findPairsOfChanged(kept_);
  }
  void findPairs(std::vector<BoxPair>& pairs) override { pairs = kept_; }

 private:
  IncrementalSearch search_;
  std::span<const Box> boxes_;
  std::vector<char> hasChanged_;
  std::vector<BoxPair> kept_;
};

}  // namespace

std::unique_ptr<Rival> makeOwn(const std::string& name, int threads) {
  if (name == "Lebesgue") return std::make_unique<Whole>(SearchMethod::kLebesgue, threads);
  if (name == "LinearCode") return std::make_unique<Whole>(SearchMethod::kLinearCode, threads);
  if (name == "SweptRows") return std::make_unique<Whole>(SearchMethod::kSweptRows, threads);
  if (name == "Hierarchy") return std::make_unique<Whole>(SearchMethod::kHierarchy, threads);
  return std::make_unique<MovedGiven>(threads);
}

}  // namespace yadefrag
