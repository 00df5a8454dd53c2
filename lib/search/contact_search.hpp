#pragma once
// The interface that all searches share: boxes in, overlapping pairs out.

#include <memory>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/comparisons.hpp"
#include "core/footprint.hpp"
#include "core/ids.hpp"

namespace yadefrag {

/// Finds the overlapping pairs among boxes. Slot i of the array given to `update` is box i; a slot
/// may be empty (`Box::absent`), boxes may appear, vanish, grow and jump between two updates, and
/// the array may change its length. Sides may be infinite, coordinates must not be NaN.
///
/// The pairs are those of `overlaps`, exactly: each once, in an order that depends on the boxes and
/// on earlier updates, never on the number of threads.
class ContactSearch {
 public:
  virtual ~ContactSearch() = default;

  /// Takes the boxes as they are now; they must stay in place until the next update.
  virtual void update(std::span<const Box> boxes) = 0;

  /// Appends all overlapping pairs.
  virtual void findPairs(std::vector<BoxPair>& pairs) = 0;

  /// Appends the slots whose boxes overlap `box`.
  virtual void findOverlaps(const Box& box, std::vector<BoxId>& found) const = 0;

  /// Forgets what it knows: the next update starts from nothing.
  virtual void clear() = 0;

  /// Comparisons since construction; zero unless asked for in `makeSearch`.
  [[nodiscard]] virtual Comparisons comparisons() const = 0;

  virtual void addTo(Footprint& footprint) const = 0;

  /// Upper limit of threads that `update` and `findPairs` may use.
  void setThreads(int threads) { threads_ = threads; }

 protected:
  int threads_ = 1;
};

enum class SearchMethod {
  kBruteForce,  ///< every box with every other: the yardstick of the tests
  kLebesgue,    ///< position codes on the Lebesgue curve (SPC), paper §4
  kLinearCode,  ///< position codes row by row (LPC), the paper's [5]
  kHierarchy,   ///< a tree of boxes (HO), the paper's [12]
};

std::unique_ptr<ContactSearch> makeSearch(SearchMethod method, bool countComparisons = false);

}  // namespace yadefrag
