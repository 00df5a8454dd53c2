#pragma once
// A search that receives the list of changed boxes: its cost depends on their number, not on that
// of all boxes.

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "search/contact_search.hpp"

namespace yadefrag {

/// Two searches: `settled_` holds the boxes as they were when they were last sorted in, `aside_`
/// those that have changed since. A changed box is tested in both. All boxes are sorted in as soon
/// as that costs less than the separate search has cost.
class IncrementalSearch {
 public:
  explicit IncrementalSearch(SearchMethod method, bool countComparisons = false);

  /// Takes all boxes, as in `ContactSearch`; the array must not move until the next call of
  /// `update` or `change`.
  void update(std::span<const Box> boxes);
  /// Appends all overlapping pairs. Valid only directly after `update`.
  void findPairs(std::vector<BoxPair>& pairs);

  /// Takes the boxes, of which only `changed` (ascending) differ from the last call of `update` or
  /// `change`. There may be more slots than before, not fewer; the new ones are in `changed`.
  void change(std::span<const Box> boxes, std::span<const BoxId> changed);
  /// Appends the overlapping pairs with at least one box of the last `changed`: each once, in an
  /// order that depends on the previous calls, never on the number of threads. Throws TooManyPairs.
  void findPairsOfChanged(std::vector<BoxPair>& pairs);

  /// Appends the slots whose boxes overlap `box`.
  void findOverlaps(const Box& box, std::vector<BoxId>& found) const;

  /// Deletes all stored data: the next call must be `update`.
  void clear();

  void setThreads(int threads);
  void setMostPairs(std::size_t most);
  [[nodiscard]] Comparisons comparisons() const;
  /// Number of boxes that are not sorted in.
  [[nodiscard]] std::size_t aside() const { return asideSlots_.size(); }

 private:
  void putAside(std::span<const BoxId> changed);
  void applyChanges();
  void pairsOf(BoxId slot, std::vector<BoxId>& found, std::vector<BoxPair>& out) const;

  std::unique_ptr<ContactSearch> settled_, aside_;
  std::span<const Box> boxes_;
  std::vector<Box> asideBoxes_;
  std::vector<BoxId> asideSlots_;          // slots of asideBoxes_
  std::vector<std::uint32_t> asidePlace_;  // by slot: index in asideBoxes_ plus one; 0: in settled_
  std::vector<BoxId> changed_;             // of the last call of `change`
  std::vector<bool> isChanged_;            // by slot
  std::vector<PartList<BoxPair>> partPairs_;
  std::size_t workAside_ = 0;  // box tests in `aside_` since all boxes were sorted in
  std::size_t mostPairs_ = std::numeric_limits<std::size_t>::max();
  int threads_ = 1;
};

}  // namespace yadefrag
