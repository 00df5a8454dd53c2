#pragma once
// Search of slaves by position codes with one box edge: SPC (paper §4.2 to §4.4) and LPC (the
// paper's [5]).

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "figure14/point_search.hpp"
#include "search/code_directory.hpp"
#include "search/level_grid.hpp"
#include "search/numbering.hpp"
#include "search/sorted_list.hpp"

namespace yadefrag {

/// Method for finding the first code of a range in the sorted list.
enum class Lookup {
  kExponential,  ///< from the segment's own slave, then binary (SPC as in the paper: §4.4, lemma
                 ///< A.3)
  kBinary,       ///< in the whole list (LPC: the log N of §4.5)
  kDirectory,    ///< SPC in this project: as in code_search.hpp, one access
};

template <class Numbering, Lookup kLookup>
class PointCodeSearch final : public PointSearch {
 public:
  explicit PointCodeSearch(const PointSearchPlan& plan)
      : inverseEdge_(1 / plan.edge), origin_(plan.origin) {}

  void update(std::span<const Vec2> points) override {
    points_ = points;
    if (places_.size() == points.size())
      moveCodes();
    else
      encodeAll();
  }

  void find(std::span<const Rectangle> masters, double halo, Csr<EntryId>& candidates) override {
    assert(masters.size() == points_.size());
    candidates.values.clear();
    candidates.offsets.assign(1, 0);
    for (std::size_t i = 0; i < masters.size(); ++i) {
      findIn(enlarged(masters[i], halo), i, candidates.values);
      candidates.offsets.push_back(static_cast<std::uint32_t>(candidates.values.size()));
    }
  }

 private:
  using Code = PositionCode<2>;
  using Numbers = std::array<std::int64_t, 2>;  // of boxes to the left and below: L of fig. 6

  struct Place {
    std::uint64_t code;
    Numbers number;
  };
  struct SortedPoint {
    Vec2 point;
    std::uint32_t slot;
  };

  /// In box edges. Where the spacing of doubles exceeds one box, coordinates share a box; the
  /// mapping stays monotone.
  [[nodiscard]] std::array<double, 2> scaled(Vec2 p) const {
    return {std::clamp((p.x - origin_.x) * inverseEdge_, -0x1p52, 0x1p52),
            std::clamp((p.y - origin_.y) * inverseEdge_, -0x1p52, 0x1p52)};
  }
  [[nodiscard]] Numbers numbers(Vec2 p) const {
    const std::array<double, 2> x = scaled(p);
    return {floorToInt(x[0]), floorToInt(x[1])};
  }
  static std::uint64_t encode(const Numbers& number) {
    return Numbering::encode({static_cast<std::uint32_t>(number[0]) & Code::kMask,
                              static_cast<std::uint32_t>(number[1]) & Code::kMask});
  }

  void encodeAll() {
    places_.resize(points_.size());
    moved_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Numbers number = numbers(points_[i]);
      places_[i] = {encode(number), number};
      moved_.push_back({places_[i].code, static_cast<std::uint32_t>(i)});
    }
    list_.clear();
    insertMoved();
    refresh();
  }

  void moveCodes() {
    moved_.clear();
    hasMoved_.assign(points_.size(), 0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (stays(points_[i], places_[i])) continue;
      hasMoved_[i] = 1;
      moved_.push_back({places_[i].code, static_cast<std::uint32_t>(i)});
    }
    if (!moved_.empty()) {
      list_.remove([&](std::uint32_t slot) { return hasMoved_[slot] != 0; });
      insertMoved();
    }
    refresh();
  }

  void insertMoved() {
    sortByCode(moved_);
    list_.insert(moved_, count_);
  }

  /// Copies the data that queries read into the order of the list.
  void refresh() {
    const std::size_t size = list_.size();
    sorted_.resize(size);
    if constexpr (kLookup == Lookup::kExponential) rank_.resize(size);
    for (std::size_t at = 0; at < size; ++at) {
      const std::uint32_t slot = list_.slot(at);
      sorted_[at] = {points_[slot], slot};
      if constexpr (kLookup == Lookup::kExponential) rank_[slot] = static_cast<std::uint32_t>(at);
    }
    if constexpr (kLookup == Lookup::kDirectory) directory_.build(list_.codes().first(size));
  }

  /// Fig. 6: two comparisons per axis decide whether the point has kept its box. Returns true if it
  /// has.
  bool stays(Vec2 p, Place& place) {
    const std::array<double, 2> x = scaled(p);
    bool same = true;
    for (int axis = 0; axis < 2; ++axis) {
      const auto floor = static_cast<double>(place.number[axis]);
      count_.move(2);
      const bool down = x[axis] < floor;
      if (!down && x[axis] < floor + 1) continue;
      same = false;
      if (!(down ? x[axis] >= floor - 1 : x[axis] < floor + 2)) {
        place.number = {floorToInt(x[0]), floorToInt(x[1])};
        place.code = encode(place.number);
        return false;
      }
      stepOver(place, axis, down);
    }
    return same;
  }

  /// Moves to the adjacent box. On the curve this needs the level of the boundary (lemma A.1); on a
  /// row, or from row to row, it is one addition.
  void stepOver(Place& place, int axis, bool down) {
    if constexpr (Numbering::kIsCurve) {
      const auto l = static_cast<std::uint32_t>(place.number[axis]);
      const std::uint32_t crossed = (down ? l : l + 1) | (std::uint32_t{1} << (Code::kBits - 1));
      count_.move(static_cast<std::uint64_t>(std::countr_zero(crossed)) + 1);
      place.code = down ? Code::stepDown(place.code, axis, l) : Code::stepUp(place.code, axis, l);
    } else {
      place.code = down ? Numbering::down(place.code, axis) : Numbering::up(place.code, axis);
    }
    place.number[axis] += down ? -1 : 1;
  }

  /// Up to four ranges (§4.4), for which the paper's bound in the length of the segment holds. A
  /// rectangle far longer than b gets as many ranges as are needed to cover little else.
  void findIn(const Rectangle& rectangle, std::size_t own, std::vector<EntryId>& found) {
    const auto visit = [&](const CodeRange& range) {
      count_.range(1);  // the comparison with the code that ends it
      const std::span<const std::uint64_t> codes = list_.codes();
      for (std::uint32_t at = firstFrom(range.start, own); at < list_.size(); ++at) {
        if (codes[at] > range.stop) break;  // a linear scan is faster than a look-up
        count_.test(5);
        if (contains(rectangle, sorted_[at].point)) found.emplace_back(sorted_[at].slot);
      }
    };
    const Numbers low = numbers(rectangle.low);
    const Numbers high = numbers(rectangle.high);
    const std::int64_t longest = std::max(high[0] - low[0], high[1] - low[1]);
    const bool wraps = (((low[0] ^ high[0]) | (low[1] ^ high[1])) >> Code::kBits) != 0;
    const std::uint64_t start = encode(low);
    const std::uint64_t stop = encode(high);
    if (longest < kFourRanges || (!Numbering::kIsCurve && longest < kMostRows))
      Numbering::forEachRange(start, stop, visit);
    else if (wraps || !Numbering::kIsCurve)
      visit({0, ~std::uint64_t{0}});
    else if constexpr (Numbering::kIsCurve)
      Numbering::forEachRangeOfLarge(start, stop, visit);
  }

  /// Index of the first code ≥ `code`.
  std::uint32_t firstFrom(std::uint64_t code, std::size_t own) {
    if constexpr (kLookup == Lookup::kDirectory) return directory_.lowerBound(code, count_);
    std::uint32_t low = 0;
    auto high = static_cast<std::uint32_t>(list_.size());
    if constexpr (kLookup == Lookup::kExponential) {
      const std::uint32_t from = rank_[own];
      std::uint32_t stride = 1;
      if (isBefore(from, code)) {
        for (low = from + 1; stride <= high - low && isBefore(low + stride - 1, code); stride *= 2)
          low += stride;
        high = std::min(high, low + stride - 1);
      } else {
        for (high = from; stride <= high && !isBefore(high - stride, code); stride *= 2)
          high -= stride;
        low = stride <= high ? high - stride + 1 : 0;
      }
    }
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (isBefore(middle, code))
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
  bool isBefore(std::uint32_t at, std::uint64_t code) {
    count_.range(1);
    return list_.codes()[at] < code;
  }

  static constexpr std::int64_t kFourRanges = 16;     // boxes
  static constexpr std::int64_t kMostRows = 1 << 16;  // above it, a scan of all points is cheaper

  double inverseEdge_;
  Vec2 origin_;
  std::span<const Vec2> points_;
  std::vector<Place> places_;  // by slot
  SortedList list_;
  std::vector<SortedPoint> sorted_;  // of the list
  std::vector<std::uint32_t> rank_;  // by slot: its index in the list
  CodeDirectory directory_;
  std::vector<CodedSlot> moved_;
  std::vector<std::uint8_t> hasMoved_;
};

}  // namespace yadefrag
