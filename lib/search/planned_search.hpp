#pragma once
// A code search that makes a new plan when the boxes no longer fit the present one: a scene that
// leaves its plane changes from 2D to 3D codes, one whose boxes grow gets longer position-code
// boxes.

#include <memory>
#include <type_traits>

#include "search/code_search.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

/// With a second numbering that one is used while enough boxes have a similar size. The order
/// of the pairs then depends on the choice.
template <template <int> class Numbering, template <int> class Even = Numbering>
class PlannedSearch final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    const SearchPlan now = planNow(boxes);
    if (!search_ || !plan_.stillServes(now) || now.isEven != plan_.isEven) start(now);
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

 private:
  [[nodiscard]] SearchPlan planNow(std::span<const Box> boxes) const {
    if constexpr (!kChooses) return planSearch(boxes);
    if (!plan_.isEven) return planSearch(boxes, tolerance::kEven);
    return planSearch(boxes, tolerance::kStillEven * tolerance::kEven, plan_.extent);
  }
  void retire() {
    retired_ += search_->comparisons();
    search_.reset();
  }
  void start(const SearchPlan& plan) {
    if (search_) retire();
    plan_ = plan;
    search_ = make<Numbering>();
    if constexpr (kChooses)
      if (plan.isEven) search_ = make<Even>();
    search_->setCounting(count_.isOn());
  }
  template <template <int> class Chosen>
  [[nodiscard]] std::unique_ptr<ContactSearch> make() const {
    if (plan_.dim == 2) return std::make_unique<CodeSearch<Chosen<2>, 2>>(plan_);
    return std::make_unique<CodeSearch<Chosen<3>, 3>>(plan_);
  }

  static constexpr bool kChooses = !std::is_same_v<Numbering<2>, Even<2>>;
  SearchPlan plan_;
  std::unique_ptr<ContactSearch> search_;
  Comparisons retired_;
};

}  // namespace yadefrag
