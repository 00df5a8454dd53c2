#pragma once
// The faster of two searches for the present boxes: rows in a sweep if nearly all boxes have a
// similar size, codes along the curve otherwise. The order of the pairs depends on the choice.

#include "curve/numbering.hpp"
#include "search/planned_search.hpp"

namespace yadefrag {

template <class Count>
class FastestSearch final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    const double even = planSearch(boxes).evenPart;
    const double least = isSwept_ ? tolerance::kStillEven : tolerance::kEven;
    if (const bool sweeps = even >= least; !search_ || sweeps != isSwept_) start(sweeps);
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
  void clear() override {
    if (search_) search_->clear();
  }
  [[nodiscard]] Comparisons comparisons() const override {
    Comparisons sum = retired_;
    if (search_) sum += search_->comparisons();
    return sum;
  }
  void addTo(Footprint& footprint) const override {
    if (search_) search_->addTo(footprint);
  }

 private:
  void start(bool sweeps) {
    if (search_) retired_ += search_->comparisons();
    isSwept_ = sweeps;
    if (sweeps)
      search_ = std::make_unique<PlannedSearch<SweptRows, Count>>();
    else
      search_ = std::make_unique<PlannedSearch<LebesgueNumbering, Count>>();
  }

  std::unique_ptr<ContactSearch> search_;
  bool isSwept_ = false;
  Comparisons retired_;
};

}  // namespace yadefrag
