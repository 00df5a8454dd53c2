#pragma once
// The common interface of all searches. Input: boxes; output: overlapping pairs.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/comparisons.hpp"
#include "core/errors.hpp"
#include "core/ids.hpp"
#include "core/parallel.hpp"

namespace yadefrag {

/// (count) Maximum of a search. Slots are 32-bit numbers of which the directory and the tree use
/// one bit as a flag.
inline constexpr std::size_t kMostBoxes = (std::size_t{1} << 31) - 1;

/// Throws RunError for more boxes than kMostBoxes.
inline void checkBoxCount(std::size_t count) {
  if (count > kMostBoxes)
    throw RunError("A search takes 2147483647 boxes at most, periodic copies included.");
}

/// Thrown by `findPairs` if there are more pairs than `setMostPairs` permits.
class TooManyPairs : public RunError {
 public:
  TooManyPairs() : RunError("More pairs of boxes overlap than there is memory for.") {}
};

/// Finds the overlapping pairs among boxes. Slot i of the array given to `update` is box i; a slot
/// may be empty (`Box::absent`), boxes may appear, vanish, grow and jump between two updates, and
/// the array may change its length. Sides may be infinite, coordinates must not be NaN.
///
/// The pairs are those of `overlaps`, exactly: each once, in an order that depends on the boxes and
/// on earlier updates, never on the number of threads.
class ContactSearch {
 public:
  virtual ~ContactSearch() = default;

  /// Takes the present boxes; the array must not move until the next update.
  virtual void update(std::span<const Box> boxes) = 0;

  /// Appends all overlapping pairs.
  virtual void findPairs(std::vector<BoxPair>& pairs) = 0;

  /// Appends the slots whose boxes overlap `box`.
  virtual void findOverlaps(const Box& box, std::vector<BoxId>& found) const = 0;

  /// The boxes of the last update are now in another array, which may have more slots. Boxes may
  /// differ only if the caller ignores them in the results of `findOverlaps`.
  virtual void relocate(std::span<const Box> boxes) = 0;

  /// Deletes all stored data: the next update is a complete one.
  virtual void clear() = 0;

  /// Comparisons since construction; zero unless `makeSearch` was called with counting.
  [[nodiscard]] virtual Comparisons comparisons() const { return count_.total(); }
  void setCounting(bool isOn) { count_ = Count(isOn); }

  /// Upper limit of threads that `update` and `findPairs` may use.
  void setThreads(int threads) { threads_ = threads; }

  /// `findPairs` throws TooManyPairs soon after it has found more than this (the excess is at most
  /// the number of boxes, per thread).
  void setMostPairs(std::size_t most) { mostPairs_ = most; }

 protected:
  [[nodiscard]] bool isFull(const std::vector<BoxPair>& pairs) const {
    return pairs.size() > mostPairs_;
  }
  /// Appends the pairs that the threads have found to `pairs`.
  void join(std::span<const PartList<BoxPair>> parts, std::vector<BoxPair>& pairs) const {
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    if (count > mostPairs_) throw TooManyPairs();
    for (const auto& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
  }

  /// A counter for each part that is searched at the same time.
  [[nodiscard]] std::vector<Count> countsOf(std::size_t parts) const {
    return std::vector<Count>(parts, Count(count_.isOn()));
  }

  Count count_;
  int threads_ = 1;
  std::size_t mostPairs_ = std::numeric_limits<std::size_t>::max();
};

enum class SearchMethod {
  kBruteForce,  ///< every box against every other: the reference of the tests
  kLebesgue,    ///< position codes on the Lebesgue curve (SPC), paper §4
  kLinearCode,  ///< position codes row by row (LPC), the paper's [5]
  kSweptRows,   ///< the same in a sweep over all boxes, which needs no look-up of rows
  kFastest,     ///< kSweptRows for boxes of similar size, kLebesgue otherwise
  kHierarchy,   ///< a tree of boxes (HO), the paper's [12]
};

std::unique_ptr<ContactSearch> makeSearch(SearchMethod method, bool countComparisons = false);

/// For a single query: no data are kept for later ones.
[[nodiscard]] inline std::vector<BoxPair> overlappingPairs(
    std::span<const Box> boxes, int threads = 1, SearchMethod method = SearchMethod::kLebesgue) {
  const std::unique_ptr<ContactSearch> search = makeSearch(method);
  search->setThreads(threads);
  search->update(boxes);
  std::vector<BoxPair> pairs;
  search->findPairs(pairs);
  return pairs;
}

}  // namespace yadefrag
