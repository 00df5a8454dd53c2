#pragma once
// A search that is told which boxes changed: its cost is that of these, not of all.

#include <memory>
#include <span>
#include <vector>

#include "search/contact_search.hpp"

namespace yadefrag {

/// Two searches: one holds the boxes as they were when they were last sorted in (`settled_`), the
/// other those that have changed since (`aside_`). A changed box asks both. When so many are aside
/// that sorting them in costs less than keeping them apart has cost, all are sorted in.
class IncrementalSearch {
 public:
  explicit IncrementalSearch(SearchMethod method, bool countComparisons = false);

  /// Takes all boxes anew, as in `ContactSearch`; they must stay in place until the next call of
  /// `update` or `change`.
  void update(std::span<const Box> boxes);
  /// Appends all overlapping pairs; to be called after `update` only.
  void findPairs(std::vector<BoxPair>& pairs);

  /// Takes the boxes of which only `changed` (ascending) differ from the last call of `update` or
  /// `change`. There may be more slots than before, not fewer; the further ones are `changed`.
  void change(std::span<const Box> boxes, std::span<const BoxId> changed);
  /// Appends the overlapping pairs of which at least one is among those given to `change` last:
  /// each once, in an order that depends on the calls so far, never on the number of threads.
  /// Throws TooManyPairs.
  void findPairsOfChanged(std::vector<BoxPair>& pairs);

  /// Appends the slots whose boxes overlap `box`.
  void findOverlaps(const Box& box, std::vector<BoxId>& found) const;

  /// Forgets what it knows: `update` has to be next.
  void clear();

  void setThreads(int threads);
  void setMostPairs(std::size_t most);
  [[nodiscard]] Comparisons comparisons() const;
  void addTo(Footprint& footprint) const;
  /// Boxes that are not sorted in.
  [[nodiscard]] std::size_t aside() const { return asideSlots_.size(); }

 private:
  void putAside(std::span<const BoxId> changed);
  void settle();
  void pairsOf(BoxId slot, std::vector<BoxId>& found, std::vector<BoxPair>& out) const;

  std::unique_ptr<ContactSearch> settled_, aside_;
  std::span<const Box> boxes_;
  std::vector<Box> asideBoxes_;
  std::vector<BoxId> asideSlots_;          // of asideBoxes_
  std::vector<std::uint32_t> asidePlace_;  // by slot: place in asideBoxes_ plus one; 0: settled
  std::vector<BoxId> changed_;             // of the last call
  std::vector<bool> isChanged_;            // by slot
  std::vector<std::vector<BoxPair>> partPairs_;
  std::size_t workAside_ = 0;  // boxes that were looked at in `aside_` since all were settled
  std::size_t mostPairs_ = std::numeric_limits<std::size_t>::max();
  int threads_ = 1;
};

}  // namespace yadefrag
