#pragma once
// Second part of code_search.hpp: updating the codes (paper §4.2, §4.3).

#include <algorithm>
#include <numeric>

#include "search/code_search.hpp"

namespace yadefrag {

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::clear() {
  places_.clear();
  started_ = false;
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::update(std::span<const Box> boxes) {
  boxes_ = boxes;
  if (!started_) {
    places_.clear();
    for (Level& level : levels_) level.clear();
    isWide_.fill(false);
    std::iota(joined_.begin(), joined_.end(), 0);
  }
  locateAll();
  if (!started_) {
    sendSparseLevelsWide();
    if (joinThinLevels()) {
      places_.clear();
      locateAll();
    }
  }
  collectMoved();
  listOccupiedLevels();
  // Start again if there are many new floors or walls, or many boxes of a size that was rare at the
  // start.
  const bool tooMany = wide_.size() > 2 * wideAtStart_ + tolerance::kWideLevelCount;
  if (!started_) {
    started_ = true;
    wideAtStart_ = wide_.size();
  } else if (tooMany) {
    started_ = false;
    update(boxes);
    return;
  }
  constexpr bool withDirectory = Numbering::kIsCurve;
  const FilterScale scale = grid_.filterScale();
  for (const int level : occupied_) levels_[level].refresh(boxes, scale, withDirectory, threads_);
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::locateAll() {
  const std::size_t before = places_.size();
  const std::size_t count = std::max(before, boxes_.size());
  places_.resize(count);  // this update removes the slots beyond the new end
  changes_.assign(count, Change::kNone);
  std::vector<Extents> extents(static_cast<std::size_t>(threads_), Extents{});
  std::vector<Count> counts = countsOf(static_cast<std::size_t>(threads_));
  const Box absent = Box::absent();
  const int parts = forEachPart(count, threads_, [&](std::size_t begin, std::size_t end, int part) {
    Count own = counts[part];  // in registers
    for (std::size_t i = begin; i < end; ++i) {
      const Box& box = i < boxes_.size() ? boxes_[i] : absent;
      Place place = places_.at(i);
      changes_[i] = locate(box, place, extents[part], own);
      places_.set(i, place);
    }
    counts[part] = own;
  });
  extents_.fill(0);
  for (int part = 0; part < parts; ++part) {
    count_.merge(counts[part]);
    for (int level = 0; level < kLevels; ++level)
      extents_[level] = std::max(extents_[level], extents[part][level]);
  }
}

template <class Numbering, int Dim>
auto CodeSearch<Numbering, Dim>::locate(const Box& box, Place& place, Extents& extents,
                                        Count& count) const -> Change {
  if (box.isAbsent()) {
    const bool was = place.level != kAbsent;
    place.level = kAbsent;
    return was ? Change::kMoved : Change::kNone;
  }
  const double side = longestSide(box);
  const int level = levelFor(box, side);
  if (level >= 0 && side > extents[level]) extents[level] = side;
  if (level == place.level) {
    if (level < 0) return Change::kNone;
    const bool stays =
        Numbering::kIsCurve ? stepWithin(box, place, count) : staysInRow(box, place, count);
    return stays ? Change::kNone : Change::kMoved;
  }
  place.level = level;
  if (level >= 0) encodeAnew(box, place);
  return Change::kMoved;
}

template <class Numbering, int Dim>
int CodeSearch<Numbering, Dim>::levelFor(const Box& box, double side) const {
  int level = grid_.levelOf(side);
  if (level >= kLevels || isWide_[level]) return kWide;
  level = joined_[level];
  for (int d = 0; d < Dim; ++d)
    if (!LevelGrid<Dim>::isNumbered(grid_.scaled(box.min[grid_.axis(d)], level, d))) return kWide;
  return level;
}

/// Fig. 6 (position_code.hpp): two comparisons per axis decide whether the box has kept its
/// position code. Returns true if it has.
template <class Numbering, int Dim>
bool CodeSearch<Numbering, Dim>::stepWithin(const Box& box, Place& place, Count& count) const {
  bool same = true;
  for (int d = 0; d < Dim; ++d) {
    const double x = grid_.scaled(box.min[grid_.axis(d)], place.level, d);
    const auto floor = static_cast<double>(grid_.origin(place.level, d) + place.number[d]);
    count.move(2);
    const bool down = x < floor;
    const bool up = x >= floor + 1;
    if (!(down | up)) continue;
    same = false;
    const bool byOne = down ? x >= floor - 1 : x < floor + 2;
    if (!byOne) {
      encodeAnew(box, place);
      return false;
    }
    const auto number = static_cast<std::uint32_t>(place.number[d]);
    const std::uint32_t crossed = down ? number : number + 1;
    count.move(static_cast<std::uint64_t>(std::countr_zero(crossed | (1U << (Code::kBits - 1)))) +
               1);
    place.code = down ? Code::stepDown(place.code, d, number) : Code::stepUp(place.code, d, number);
    place.number[d] += down ? -1 : 1;
  }
  return same;
}

/// Returns true if the box has kept its code row by row; if not, the box is encoded anew.
template <class Numbering, int Dim>
bool CodeSearch<Numbering, Dim>::staysInRow(const Box& box, Place& place, Count& count) const {
  if constexpr (!Numbering::kIsCurve) {
    const Cell before = Numbering::decode(place.code);
    for (int d = 0; d < Dim; ++d) {
      count.move(2);
      const std::int32_t now = grid_.number(box.min[grid_.axis(d)], place.level, d);
      if ((static_cast<std::uint32_t>(now) & Code::kMask) == before[d]) continue;
      encodeAnew(box, place);
      return false;
    }
  }
  return true;
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::encodeAnew(const Box& box, Place& place) const {
  Cell cell;
  for (int d = 0; d < Dim; ++d) {
    place.number[d] = grid_.number(box.min[grid_.axis(d)], place.level, d);
    cell[d] = static_cast<std::uint32_t>(place.number[d]) & Code::kMask;
  }
  place.code = Numbering::encode(cell);
}

/// A separate level for a few boxes would cost every smaller box a range search.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::sendSparseLevelsWide() {
  std::array<std::size_t, kLevels> population{};
  for (const int level : places_.levels)
    if (level >= 0) ++population[level];
  for (int level = 0; level < kLevels; ++level)
    isWide_[level] = population[level] > 0 && population[level] <= tolerance::kWideLevelCount;
  for (std::int8_t& level : places_.levels)
    if (level >= 0 && isWide_[level]) level = kWide;
}

/// If most boxes of a level are alone even in position-code boxes of twice the edge, the level is
/// merged into the next one: that adds few candidates there and saves the search between the two.
/// In rows, boxes that were merged into a level count there, too: coarse levels have long rows.
/// Returns true if any levels were merged.
template <class Numbering, int Dim>
bool CodeSearch<Numbering, Dim>::joinThinLevels() {
  std::array<std::vector<std::uint32_t>, kLevels + 1> members;
  for (std::size_t slot = 0; slot < places_.size(); ++slot)
    if (const int level = places_.levels[slot]; level >= 0)
      members[level].push_back(static_cast<std::uint32_t>(slot));
  std::array<int, kLevels> next;
  std::iota(next.begin(), next.end(), 0);
  bool any = false;
  for (int level = 0; level < kLevels - 1; ++level) {
    // Without boxes on the next level there is no level to merge into.
    if (members[level].empty() || members[level + 1].empty()) continue;
    if (!areThin(members[level], level + 1)) continue;
    next[level] = level + 1;
    any = true;
    if (Numbering::kIsSwept)
      members[level + 1].insert(members[level + 1].end(), members[level].begin(),
                                members[level].end());
  }
  for (int level = kLevels - 1; level >= 0; --level)
    joined_[level] = next[level] == level ? level : joined_[next[level]];
  return any;
}

/// True if there are few of these boxes in each position-code box of a level that has any.
template <class Numbering, int Dim>
bool CodeSearch<Numbering, Dim>::areThin(std::span<const std::uint32_t> slots, int level) const {
  std::vector<CodedSlot> codes;
  for (const std::uint32_t slot : slots) {
    Cell cell;
    for (int d = 0; d < Dim; ++d) {
      const std::int32_t number = grid_.number(boxes_[slot].min[grid_.axis(d)], level, d);
      cell[d] = static_cast<std::uint32_t>(number) & Code::kMask;
    }
    codes.push_back({Code::encode(cell), 0});
  }
  sortByCode(codes);
  const auto same = [](const CodedSlot& a, const CodedSlot& b) { return a.code == b.code; };
  const auto boxes = std::unique(codes.begin(), codes.end(), same) - codes.begin();
  return static_cast<double>(codes.size()) <= tolerance::kThinLevel * static_cast<double>(boxes);
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::collectMoved() {
  for (auto& list : arriving_) list.clear();
  wide_.clear();
  bool any = false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const int level = places_.levels[i];
    if (level == kWide) wide_.add(i);
    if (changes_[i] == Change::kNone) continue;
    any = true;
    if (level >= 0) arriving_[level].push_back({places_.codes[i], static_cast<std::uint32_t>(i)});
  }
  if (any) {
    for (int level = 0; level < kLevels; ++level) {
      if (levels_[level].size() > 0)
        levels_[level].remove([&](std::uint32_t slot) { return changes_[slot] != Change::kNone; });
      if (!arriving_[level].empty()) levels_[level].insert(arriving_[level], count_);
      // Most boxes arrive at the start only.
      if (8 * arriving_[level].size() > levels_[level].size()) arriving_[level] = {};
    }
  }
  places_.resize(boxes_.size());
}

template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::listOccupiedLevels() {
  occupied_.clear();
  for (int level = 0; level < kLevels; ++level)
    if (levels_[level].size() > 0) occupied_.push_back(level);
}

}  // namespace yadefrag
