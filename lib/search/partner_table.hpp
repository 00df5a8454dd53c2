#pragma once
// A table of pairs by their first member. It finds whether a pair is present, and its index.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/csr.hpp"
#include "core/tolerances/search.hpp"

namespace yadefrag {

class PartnerTable {
 public:
  /// Takes `count` pairs; `firstOf(i)` < `rows` and `secondOf(i)` are the members of pair i. A pair
  /// may occur more than once.
  template <class FirstOf, class SecondOf>
  void build(std::size_t rows, std::size_t count, FirstOf firstOf, SecondOf secondOf) {
    fillRows(rows_, rows, count, firstOf, [&](std::size_t i) {
      return Partner{static_cast<std::uint32_t>(secondOf(i)), static_cast<std::uint32_t>(i)};
    });
    for (std::size_t r = 0; r < rows; ++r) {
      Partner* begin = rows_.values.data() + rows_.offsets[r];
      Partner* end = rows_.values.data() + rows_.offsets[r + 1];
      if (isLong(static_cast<std::size_t>(end - begin)))
        std::sort(begin, end, [](const Partner& a, const Partner& b) {
          return a.second != b.second ? a.second < b.second : a.index < b.index;
        });
    }
  }

  /// Calls `visit(i)` for every index i of the pair, ascending. Returns the number of comparisons,
  /// which is at most logarithmic in the number of partners.
  template <class Visit>
  std::size_t forEach(std::size_t first, std::uint32_t second, Visit visit) const {
    if (first >= rows_.rows()) return 0;
    const auto row = rows_.row(first);
    std::size_t comparisons = 0;
    auto partner = row.begin();
    if (isLong(row.size())) {
      partner = std::lower_bound(row.begin(), row.end(), second, [&](const Partner& a, auto value) {
        ++comparisons;
        return a.second < value;
      });
      for (; partner != row.end() && partner->second == second; ++partner, ++comparisons)
        visit(partner->index);
      return comparisons;
    }
    for (; partner != row.end(); ++partner, ++comparisons)
      if (partner->second == second) visit(partner->index);
    return comparisons;
  }

 private:
  struct Partner {
    std::uint32_t second;
    std::uint32_t index;
  };
  static bool isLong(std::size_t size) { return size > tolerance::kLongRow; }

  Csr<Partner> rows_;  // long rows are sorted
};

}  // namespace yadefrag
