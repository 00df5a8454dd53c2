#pragma once
// A code search that makes a new plan when the boxes no longer fit the present one: a scene that
// leaves its plane changes from 2D to 3D codes, one whose boxes grow gets longer position-code
// boxes.

#include "search/box_count.hpp"
#include "search/code_search.hpp"

namespace yadefrag {

template <template <int> class Numbering, class Count>
class PlannedSearch final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    const SearchPlan now = planSearch(boxes, Numbering<2>::kEdgeOverExtent);
    if (!search_ || !plan_.stillServes(now)) start(now);
    search_->setThreads(threads_);
    search_->update(boxes);
  }

  void findPairs(std::vector<BoxPair>& pairs) override {
    if (!search_) return;
    search_->setMostPairs(mostPairs_);
    search_->findPairs(pairs);
  }
  void findOverlaps(const Box& box, std::vector<BoxId>& found) const override {
    if (search_) search_->findOverlaps(box, found);
  }
  void relocate(std::span<const Box> boxes) override {
    if (search_) search_->relocate(boxes);
  }
  void clear() override { search_ ? retire() : void(); }

  [[nodiscard]] Comparisons comparisons() const override {
    Comparisons sum = retired_;
    if (search_) sum += search_->comparisons();
    return sum;
  }

  void addTo(Footprint& footprint) const override {
    if (search_) search_->addTo(footprint);
  }

 private:
  void retire() {
    retired_ += search_->comparisons();
    search_.reset();
  }
  void start(const SearchPlan& plan) {
    if (search_) retire();
    plan_ = plan;
    if (plan.dim == 2)
      search_ = std::make_unique<CodeSearch<Numbering<2>, 2, Count>>(plan);
    else
      search_ = std::make_unique<CodeSearch<Numbering<3>, 3, Count>>(plan);
  }

  SearchPlan plan_;
  std::unique_ptr<ContactSearch> search_;
  Comparisons retired_;
};

}  // namespace yadefrag
