#include "search/code_level.hpp"

#include "core/parallel.hpp"

namespace yadefrag {

void CodeLevel::refresh(std::span<const Box> boxes, const FilterScale& scale, bool withDirectory,
                        int threads) {
  boxes_.resize(list_.size());
  filters_.resize(list_.size());
  forEachPart(list_.size(), threads, [&](std::size_t begin, std::size_t end, int) {
    constexpr std::size_t ahead = 16;  // the boxes are in the order of their slots: prefetch
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) {
        const Box* next = &boxes[list_[i + ahead].slot];
        __builtin_prefetch(next);
        __builtin_prefetch(&next->max[2]);
      }
      boxes_[i] = {boxes[list_[i].slot], list_[i].slot};
      filters_[i] = FilterBox(boxes_[i].box, scale);
    }
  });
  if (!changed_) return;
  changed_ = false;
  codes_.reserve(list_.size() + 1);
  codes_.resize(list_.size());
  for (std::size_t i = 0; i < list_.size(); ++i) codes_[i] = list_[i].code;
  if (withDirectory) directory_.build(codes_);
  codes_.push_back(kEnd);
}

}  // namespace yadefrag
