#pragma once
// Search by position codes: the paper's SPC (§4) and, with another numbering, LPC.
//
// Differences from the paper: nodes and segments are boxes, keyed by their lower corner, so that a
// query rectangle is enlarged by the longest box of the level that is searched. Boxes of very
// different size are stored on different levels. Pairs on one level are found once, from the box
// that comes first on the curve.

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "core/comparisons.hpp"
#include "core/parallel.hpp"
#include "search/code_level.hpp"
#include "search/contact_search.hpp"
#include "search/level_grid.hpp"
#include "search/numbering.hpp"
#include "search/row_begins.hpp"
#include "search/wide_boxes.hpp"

namespace yadefrag {

template <class Numbering, int Dim>
class CodeSearch final : public ContactSearch {
 public:
  explicit CodeSearch(const SearchPlan& plan)
      : grid_(plan, Numbering::kEdgeOverExtent, Numbering::kPartsOfX, Numbering::kFirst) {}

  void update(std::span<const Box> boxes) override;
  void findPairs(std::vector<BoxPair>& pairs) override;
  void findOverlaps(const Box& box, std::vector<BoxId>& found) const override;
  void relocate(std::span<const Box> boxes) override { boxes_ = boxes; }
  void clear() override;

 private:
  using Code = PositionCode<Dim>;
  using Cell = typename Code::Cell;
  using Level = CodeLevel<std::conditional_t<Numbering::kIsSwept, FilterBlocks, FilterList>>;

  static constexpr int kAbsent = -1;
  static constexpr int kWide = -2;

  /// Place of a slot at the last update (L_x, L_y of the paper, and the code).
  struct Place {
    std::uint64_t code = 0;
    std::array<std::int32_t, Dim> number{};
    int level = kAbsent;
  };
  /// The places of all slots. The numbers are stored on the curve only: those of a row are parts of
  /// its code.
  struct Places {
    std::vector<std::uint64_t> codes;
    std::vector<std::array<std::int32_t, Dim>> numbers;
    std::vector<std::int8_t> levels;

    [[nodiscard]] std::size_t size() const { return levels.size(); }
    void resize(std::size_t size) {
      codes.resize(size);
      levels.resize(size, kAbsent);
      if constexpr (Numbering::kIsCurve) numbers.resize(size);
    }
    void clear() { resize(0); }
    [[nodiscard]] Place at(std::size_t slot) const {
      Place place{codes[slot], {}, levels[slot]};
      if constexpr (Numbering::kIsCurve) place.number = numbers[slot];
      return place;
    }
    void set(std::size_t slot, const Place& place) {
      codes[slot] = place.code;
      levels[slot] = static_cast<std::int8_t>(place.level);
      if constexpr (Numbering::kIsCurve) numbers[slot] = place.number;
    }
  };
  enum class Change : std::uint8_t { kNone, kMoved };
  enum class Extent { kSmall, kLarge, kWraps };
  using Extents = std::array<double, kLevels>;

  void locateAll();
  void collectMoved();
  Change locate(const Box& box, Place& place, Extents& extents, Count& count) const;
  [[nodiscard]] int levelFor(const Box& box, double side) const;
  bool stepWithin(const Box& box, Place& place, Count& count) const;
  bool staysInRow(const Box& box, Place& place, Count& count) const;
  void encodeAnew(const Box& box, Place& place) const;
  void sendSparseLevelsWide();
  bool joinThinLevels();
  [[nodiscard]] bool areThin(std::span<const std::uint32_t> slots, int level) const;
  void listOccupiedLevels();

  void joinSections(std::span<const std::vector<std::size_t>> ends,
                    std::vector<BoxPair>& pairs) const;
  void pairsOfLevel(int level, std::size_t from, std::size_t to, RowBegins& begins,
                    std::vector<BoxPair>& out, Count& count) const;
  void pairsOf(int level, std::size_t i, std::span<const int> searched, RowBegins& begins,
               std::vector<BoxPair>& out, Count& count) const;
  template <class Visit>
  void visitLaterNeighbours(const Level& level, int own, std::size_t i, Count& count,
                            Visit visit) const;
  static void countRange(const Level& level, std::size_t begin, const CodeRange& range,
                         Count& count);
  template <class Visit>
  void visitRange(const Level& level, const FilterBox& filter, const Box& box, std::uint32_t begin,
                  const CodeRange& range, Count& count, Visit visit) const;
  void sweepRows(int level, std::size_t from, std::size_t to, std::vector<BoxPair>& out,
                 Count& count) const;
  void outerRows(const Level& level, std::size_t i, std::vector<BlockRange>& ranges,
                 Count& count) const;
  template <class Visit>
  void visitRectangle(const Box& box, int at, RowBegins::OfLevel* begins, Count& count,
                      Visit visit) const;
  std::uint32_t lowerBound(const Level& level, std::uint64_t code, Count& count) const;
  double lowestStart(const Box& box, int axis, int level) const;
  Extent rectangleOf(const Box& box, int level, CodeRange& corners) const;
  [[nodiscard]] bool searchesLevel(int own, int other) const;

  LevelGrid<Dim> grid_;
  std::span<const Box> boxes_;
  Places places_;
  std::vector<Change> changes_;
  std::array<Level, kLevels> levels_;
  Extents extents_{};                   // longest side on each level at present
  std::array<bool, kLevels> isWide_{};  // levels with too few boxes for codes
  std::array<int, kLevels> joined_{};   // the level that stores the boxes of each level
  std::vector<int> occupied_;           // levels with boxes, fine to coarse
  WideBoxes wide_;
  std::size_t wideAtStart_ = 0;
  bool started_ = false;
  std::array<std::vector<CodedSlot>, kLevels> arriving_;
  std::vector<PartList<BoxPair>> partPairs_;
};

}  // namespace yadefrag

#include "search/code_search_levels.hpp"
#include "search/code_search_pairs.hpp"
#include "search/code_search_update.hpp"
