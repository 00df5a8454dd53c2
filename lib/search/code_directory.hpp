#pragma once
// Finds a position code in a sorted list in a constant number of steps.
//
// The paper (§4.4) finds the ends of a range by exponential search, starting from the previous
// result. A directory over the leading bits of the codes, with about two slots per code, finds the
// beginning of a range in one access if codes are evenly distributed. A slot with too many codes
// has a directory of its own: two distant clusters cost one access more.

#include <cstdint>
#include <span>
#include <vector>

#include "core/comparisons.hpp"

namespace yadefrag {

class CodeDirectory {
 public:
  /// `codes` is ascending and must stay in place while the directory is used.
  void build(std::span<const std::uint64_t> codes);

  /// Index of the first code ≥ `code`.
  [[nodiscard]] std::uint32_t lowerBound(std::uint64_t code, Count& count) const {
    std::uint32_t at = 0;
    for (;;) {
      const Node& node = nodes_[at];
      count.range(2);
      if (code <= node.first) return node.begin;
      if (code > node.last) return node.end;
      const std::uint32_t* slot = &table_[node.table + ((code - node.first) >> node.shift)];
      if (*slot & kChild) {
        at = *slot & ~kChild;
        continue;
      }
      return scan(code, *slot, startOf(slot[1]), count);
    }
  }

 private:
  struct Node {
    std::uint64_t first, last;  // smallest and greatest code below this node
    std::uint32_t begin, end;   // their indices
    std::uint32_t table;        // first slot; slot s holds (code − first) >> shift = s
    int shift;
  };
  static constexpr std::uint32_t kChild = std::uint32_t{1} << 31;

  [[nodiscard]] std::uint32_t startOf(std::uint32_t slot) const {
    return slot & kChild ? nodes_[slot & ~kChild].begin : slot;
  }

  std::uint32_t scan(std::uint64_t code, std::uint32_t begin, std::uint32_t end,
                     Count& count) const {
    while (end - begin > 8) {  // needed only if many boxes have the same code
      const std::uint32_t middle = begin + (end - begin) / 2;
      count.range(1);
      if (codes_[middle] < code)
        begin = middle + 1;
      else
        end = middle;
    }
    while (begin < end && codes_[begin] < code) {
      count.range(1);
      ++begin;
    }
    return begin;
  }

  void buildNode(std::uint32_t at);
  void splitOverfullSlots(std::uint32_t at, std::uint32_t slots);

  std::span<const std::uint64_t> codes_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> table_;
};

}  // namespace yadefrag
