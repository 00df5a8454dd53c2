#pragma once
// Second part of code_search.hpp: updating the codes (paper §4.2, §4.3).

#include <algorithm>
#include <numeric>

#include "search/code_search.hpp"

namespace yadefrag {

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::clear() {
  places_.clear();
  started_ = false;
}

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::update(std::span<const Box> boxes) {
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

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::locateAll() {
  const std::size_t before = places_.size();
  const std::size_t count = std::max(before, boxes_.size());
  places_.resize(count);  // this update removes the slots beyond the new end
  changes_.assign(count, Change::kNone);
  std::vector<Extents> extents(static_cast<std::size_t>(threads_), Extents{});
  std::vector<Count> counts(static_cast<std::size_t>(threads_));
  const Box absent = Box::absent();
  const int parts = forEachPart(count, threads_, [&](std::size_t begin, std::size_t end, int part) {
    for (std::size_t i = begin; i < end; ++i) {
      const Box& box = i < boxes_.size() ? boxes_[i] : absent;
      changes_[i] = locate(box, places_[i], extents[part], counts[part]);
    }
  });
  extents_.fill(0);
  for (int part = 0; part < parts; ++part) {
    count_.merge(counts[part]);
    for (int level = 0; level < kLevels; ++level)
      extents_[level] = std::max(extents_[level], extents[part][level]);
  }
}

template <class Numbering, int Dim, class Count>
auto CodeSearch<Numbering, Dim, Count>::locate(const Box& box, Place& place, Extents& extents,
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
    if (level < 0 || stepWithin(box, place, count)) return Change::kNone;
    return Change::kMoved;
  }
  place.level = level;
  if (level >= 0) encodeAnew(box, place);
  return Change::kMoved;
}

template <class Numbering, int Dim, class Count>
int CodeSearch<Numbering, Dim, Count>::levelFor(const Box& box, double side) const {
  int level = grid_.levelOf(side);
  if (level >= kLevels || isWide_[level]) return kWide;
  level = joined_[level];
  for (int d = 0; d < Dim; ++d)
    if (!LevelGrid<Dim>::isNumbered(grid_.scaled(box.min[grid_.axis(d)], level, d))) return kWide;
  return level;
}

/// Fig. 6 (position_code.hpp): two comparisons per axis decide whether the box has kept its
/// position code. Returns true if it has.
template <class Numbering, int Dim, class Count>
bool CodeSearch<Numbering, Dim, Count>::stepWithin(const Box& box, Place& place,
                                                   Count& count) const {
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
    if (!Numbering::kIsCurve || !byOne) {
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

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::encodeAnew(const Box& box, Place& place) const {
  Cell cell;
  for (int d = 0; d < Dim; ++d) {
    place.number[d] = grid_.number(box.min[grid_.axis(d)], place.level, d);
    cell[d] = static_cast<std::uint32_t>(place.number[d]) & Code::kMask;
  }
  place.code = Numbering::encode(cell);
}

/// A separate level for a few boxes would cost every smaller box a range search.
template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::sendSparseLevelsWide() {
  std::array<std::size_t, kLevels> population{};
  for (const Place& place : places_)
    if (place.level >= 0) ++population[place.level];
  for (int level = 0; level < kLevels; ++level)
    isWide_[level] = population[level] > 0 && population[level] <= tolerance::kWideLevelCount;
  for (Place& place : places_)
    if (place.level >= 0 && isWide_[place.level]) place.level = kWide;
}

/// If most boxes of a level are alone even in position-code boxes of twice the edge, the level is
/// merged into the next one: that adds no candidates there and saves all other levels one search.
/// Returns true if any levels were merged.
template <class Numbering, int Dim, class Count>
bool CodeSearch<Numbering, Dim, Count>::joinThinLevels() {
  std::array<std::vector<CodedSlot>, kLevels> parents;
  std::array<bool, kLevels + 1> occupied{};
  for (const Place& place : places_)
    if (place.level >= 0) occupied[place.level] = true;
  for (const Place& place : places_) {
    // Without boxes on the next level there is no level to merge into.
    if (place.level < 0 || !occupied[place.level + 1]) continue;
    Cell cell;
    for (int d = 0; d < Dim; ++d)
      cell[d] = static_cast<std::uint32_t>(place.number[d] >> 1) & Code::kMask;
    parents[place.level].push_back({Code::encode(cell), 0});
  }
  bool any = false;
  for (int level = kLevels - 2; level >= 0; --level) {
    std::vector<CodedSlot>& codes = parents[level];
    if (codes.empty()) continue;
    sortByCode(codes);
    const auto same = [](const CodedSlot& a, const CodedSlot& b) { return a.code == b.code; };
    const auto all = static_cast<double>(codes.size());
    const auto boxes = std::unique(codes.begin(), codes.end(), same) - codes.begin();
    if (all > tolerance::kThinLevel * static_cast<double>(boxes)) continue;
    joined_[level] = joined_[level + 1];
    any = true;
  }
  return any;
}

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::collectMoved() {
  for (auto& list : arriving_) list.clear();
  wide_.clear();
  bool any = false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    if (place.level == kWide) wide_.add(i);
    if (changes_[i] == Change::kNone) continue;
    any = true;
    if (place.level >= 0)
      arriving_[place.level].push_back({place.code, static_cast<std::uint32_t>(i)});
  }
  if (any) {
    for (int level = 0; level < kLevels; ++level) {
      if (levels_[level].size() > 0)
        levels_[level].remove([&](std::uint32_t slot) { return changes_[slot] != Change::kNone; });
      if (!arriving_[level].empty()) levels_[level].insert(arriving_[level], count_);
      // Most boxes arrive at the start only.
      if (2 * arriving_[level].size() > levels_[level].size()) arriving_[level] = {};
    }
  }
  places_.resize(boxes_.size());
}

template <class Numbering, int Dim, class Count>
void CodeSearch<Numbering, Dim, Count>::listOccupiedLevels() {
  occupied_.clear();
  for (int level = 0; level < kLevels; ++level)
    if (levels_[level].size() > 0) occupied_.push_back(level);
}

}  // namespace yadefrag
