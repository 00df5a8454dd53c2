#pragma once
// Third part of code_search.hpp: the levels and threads of a search for pairs.

#include <algorithm>

#include "search/code_search.hpp"

namespace yadefrag {

/// Every part gets its share of each level, since coarse boxes take longer than fine ones. Pairs
/// are in the order of the levels, on each first those of its rows, then all others, and in both
/// that of the boxes. A single part needs no list of its own.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::findPairs(std::vector<BoxPair>& pairs) {
  std::size_t total = 0;
  for (const int level : occupied_) total += levels_[level].size();
  const auto parts = static_cast<std::size_t>(threadsFor(total, threads_));
  const bool inPlace = parts == 1 && pairs.empty();
  partPairs_.resize(inPlace ? 0 : parts);
  std::vector<Count> counts = countsOf(parts);
  std::vector<std::vector<std::size_t>> ends(
      parts);  // by part: of the rows and the rest of a level
  forEachPart(total, threads_, [&](std::size_t begin, std::size_t end, int part) {
    std::vector<BoxPair>& out = inPlace ? pairs : partPairs_[part];
    out.clear();
    RowBegins begins;
    for (const int level : occupied_) {
      const std::size_t size = levels_[level].size();
      const std::size_t from = size * begin / total, to = size * end / total;
      if constexpr (Numbering::kIsSwept) sweepRows(level, from, to, out, counts[part]);
      ends[part].push_back(out.size());
      pairsOfLevel(level, from, to, begins, out, counts[part]);
      ends[part].push_back(out.size());
    }
  });
  for (const Count& count : counts) count_.merge(count);
  if (!inPlace) joinSections(ends, pairs);
  if (inPlace && isFull(pairs)) {
    pairs.clear();
    throw TooManyPairs();
  }
  wide_.pairsAmong(boxes_, pairs, count_, mostPairs_);
}

/// Appends what the parts have found; `ends`: of their sections, by part.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::joinSections(std::span<const std::vector<std::size_t>> ends,
                                              std::vector<BoxPair>& pairs) const {
  std::size_t found = 0;
  for (const auto& part : partPairs_) found += part.size();
  if (found > mostPairs_) throw TooManyPairs();
  pairs.reserve(pairs.size() + found);
  for (std::size_t k = 0; k < ends.front().size(); ++k)
    for (std::size_t part = 0; part < partPairs_.size(); ++part) {
      const BoxPair* first = partPairs_[part].data();
      pairs.insert(pairs.end(), first + (k == 0 ? 0 : ends[part][k - 1]), first + ends[part][k]);
    }
}

/// Pairs of the boxes [from, to) of a level, except those in rows that are swept.
template <class Numbering, int Dim>
void CodeSearch<Numbering, Dim>::pairsOfLevel(int own, std::size_t from, std::size_t to,
                                              RowBegins& begins, std::vector<BoxPair>& out,
                                              Count& count) const {
  std::vector<int> searched;
  for (const int other : occupied_)
    if (other == own ? !Numbering::kIsSwept : searchesLevel(own, other)) searched.push_back(other);
  if (searched.empty() && wide_.size() == 0) return;
  constexpr std::size_t ahead = 16;  // the boxes are in the order of their slots: prefetch
  for (std::size_t i = from; i < to && !isFull(out); ++i) {
    if (i + ahead < to) prefetch(boxes_[levels_[own].slot(i + ahead)]);
    pairsOf(own, i, searched, begins, out, count);
  }
}

/// True if the boxes of the first of two levels search the second. Normally the finer level
/// searches the coarser one, since each fine box meets few coarse boxes. If there are many more
/// fine boxes, it is cheaper to find for each coarse box the fine ones, on the ranges of codes that
/// it covers.
template <class Numbering, int Dim>
bool CodeSearch<Numbering, Dim>::searchesLevel(int own, int other) const {
  const int fine = std::min(own, other);
  const int coarse = std::max(own, other);
  const bool coarseSearches =
      tolerance::kFinePerCoarse * levels_[coarse].size() <= levels_[fine].size();
  return own == (coarseSearches ? coarse : fine);
}

}  // namespace yadefrag
