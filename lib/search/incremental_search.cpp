#include "search/incremental_search.hpp"

#include <algorithm>
#include <cassert>

#include "core/parallel.hpp"
#include "core/tolerances/search.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {

IncrementalSearch::IncrementalSearch(SearchMethod method, bool countComparisons)
    : settled_(makeSearch(method, countComparisons)),
      aside_(makeSearch(method, countComparisons)) {}

void IncrementalSearch::update(std::span<const Box> boxes) {
  boxes_ = boxes;
  applyChanges();
}

void IncrementalSearch::applyChanges() {
  settled_->update(boxes_);
  asidePlace_.assign(boxes_.size(), 0);
  isChanged_.assign(boxes_.size(), false);
  changed_.clear();
  asideBoxes_.clear();
  asideSlots_.clear();
  aside_->clear();
  workAside_ = 0;
}

void IncrementalSearch::findPairs(std::vector<BoxPair>& pairs) { settled_->findPairs(pairs); }

void IncrementalSearch::change(std::span<const Box> boxes, std::span<const BoxId> changed) {
  checkBoxCount(boxes.size());
  assert(std::ranges::is_sorted(changed) &&
         (changed.empty() || changed.back().value < boxes.size()));
  boxes_ = boxes;
  for (const BoxId slot : changed_) isChanged_[slot.value] = false;
  workAside_ += asideSlots_.size() + changed.size();
  if (workAside_ > tolerance::kAsideWork * boxes.size()) {
    applyChanges();
  } else {
    settled_->relocate(boxes);
    putAside(changed);
  }
  changed_.assign(changed.begin(), changed.end());
  isChanged_.resize(boxes.size(), false);
  for (const BoxId slot : changed_) isChanged_[slot.value] = true;
}

void IncrementalSearch::putAside(std::span<const BoxId> changed) {
  asidePlace_.resize(boxes_.size(), 0);
  for (const BoxId slot : changed) {
    std::uint32_t& place = asidePlace_[slot.value];
    if (place == 0) {
      asideSlots_.push_back(slot);
      asideBoxes_.emplace_back();
      place = static_cast<std::uint32_t>(asideSlots_.size());
    }
    asideBoxes_[place - 1] = boxes_[slot.value];
  }
  aside_->update(asideBoxes_);
}

void IncrementalSearch::findPairsOfChanged(std::vector<BoxPair>& pairs) {
  const std::size_t before = pairs.size();
  const int parts = threadsFor(changed_.size(), threads_);
  partPairs_.resize(parts > 1 ? static_cast<std::size_t>(parts) : 0);
  forEachPart(changed_.size(), threads_, [&](std::size_t begin, std::size_t end, int part) {
    std::vector<BoxPair>& out = parts > 1 ? partPairs_[static_cast<std::size_t>(part)] : pairs;
    if (parts > 1) out.clear();
    const std::size_t first = out.size();
    std::vector<BoxId> found;
    for (std::size_t i = begin; i < end && out.size() - first <= mostPairs_; ++i)
      pairsOf(changed_[i], found, out);
  });
  for (const auto& found : partPairs_) pairs.insert(pairs.end(), found.begin(), found.end());
  if (pairs.size() - before <= mostPairs_) return;
  pairs.resize(before);
  throw TooManyPairs();
}

/// If both boxes of a pair have changed, both find it: only the one with the smaller slot stores
/// it.
void IncrementalSearch::pairsOf(BoxId slot, std::vector<BoxId>& found,
                                std::vector<BoxPair>& out) const {
  const Box& box = boxes_[slot.value];
  if (box.isAbsent()) return;
  found.clear();
  findOverlaps(box, found);
  for (const BoxId other : found) {
    if (other == slot || (isChanged_[other.value] && other < slot)) continue;
    out.push_back(orderedPair(slot, other));
  }
}

void IncrementalSearch::findOverlaps(const Box& box, std::vector<BoxId>& found) const {
  const std::size_t first = found.size();
  settled_->findOverlaps(box, found);
  if (asideSlots_.empty()) return;
  const auto isAside = [&](BoxId slot) { return asidePlace_[slot.value] != 0; };
  found.erase(
      std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), isAside),
      found.end());
  const std::size_t second = found.size();
  aside_->findOverlaps(box, found);
  for (std::size_t i = second; i < found.size(); ++i) found[i] = asideSlots_[found[i].value];
}

void IncrementalSearch::clear() {
  settled_->clear();
  aside_->clear();
}

void IncrementalSearch::setThreads(int threads) {
  threads_ = threads;
  settled_->setThreads(threads);
  aside_->setThreads(threads);
}

void IncrementalSearch::setMostPairs(std::size_t most) {
  mostPairs_ = most;
  settled_->setMostPairs(most);
}

Comparisons IncrementalSearch::comparisons() const {
  Comparisons sum = settled_->comparisons();
  sum += aside_->comparisons();
  return sum;
}

}  // namespace yadefrag
