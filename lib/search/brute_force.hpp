#pragma once
// Tests every box against every other: the reference for all other searches.

#include "search/contact_search.hpp"

namespace yadefrag {

template <class Count>
class BruteForce final : public ContactSearch {
 public:
  void update(std::span<const Box> boxes) override {
    checkBoxCount(boxes.size());
    boxes_ = boxes;
  }
  void relocate(std::span<const Box> boxes) override { boxes_ = boxes; }
  void clear() override { boxes_ = {}; }
  [[nodiscard]] Comparisons comparisons() const override { return count_.total(); }

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
  Count count_;
};

}  // namespace yadefrag
