#include "contact/candidates.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace yadefrag {

namespace {

/// Calls `visit(pairs)` for each slave of pairs, which it sorts.
template <class Visit>
void forRows(std::vector<SlaveMaster>& pairs, Visit visit) {
  std::sort(pairs.begin(), pairs.end());
  for (auto begin = pairs.begin(); begin != pairs.end();) {
    const auto end = std::find_if(
        begin, pairs.end(), [&](const SlaveMaster& pair) { return pair.slave != begin->slave; });
    visit(std::span<const SlaveMaster>(begin, end));
    begin = end;
  }
}

}  // namespace

void Candidates::index(std::size_t entries) {
  rowOf_.resize(std::max(entries, rowOf_.size()), kNone);
  for (; indexed_ < slaves.size(); ++indexed_) {
    const auto row = static_cast<std::uint32_t>(indexed_);
    const std::uint32_t former = std::exchange(rowOf_[slaves[row].value], row);
    const auto slaveOf = [this](std::uint32_t r) { return slaves[r]; };
    const auto at = rows_.empty() || slaveOf(rows_.back()) < slaves[row]
                        ? rows_.end()
                        : std::ranges::lower_bound(rows_, slaves[row], {}, slaveOf);
    if (former == kNone)
      rows_.insert(at, row);
    else
      *at = row;
  }
}

void Candidates::appendSlavesOf(EntryId master, std::vector<EntryId>& found) {
  placeOf_.resize(rowOf_.size(), kNone);
  // Only scenes with cracks need these lists.
  for (std::size_t place = nextPlace_.size(); place < masters.size(); ++place) {
    std::uint32_t& head = placeOf_[masters[place].value];
    nextPlace_.push_back(std::exchange(head, static_cast<std::uint32_t>(place)));
  }
  for (std::uint32_t at = placeOf_[master.value]; at != kNone; at = nextPlace_[at]) {
    const auto after = std::upper_bound(offsets.begin(), offsets.end(), at);
    const auto row = static_cast<std::size_t>(after - offsets.begin()) - 1;
    if (rowOf(slaves[row]) == row) found.push_back(slaves[row]);
  }
}

Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             std::size_t entries) {
  Candidates next;
  next.masters.reserve(pairs.size());
  next.offsets.push_back(0);
  forRows(pairs, [&](std::span<const SlaveMaster> row) {
    next.slaves.push_back(row.front().slave);
    for (const SlaveMaster& pair : row) next.masters.push_back(pair.master);
    next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
  });
  next.index(entries);
  std::swap(candidates, next);
  return next;
}

void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   std::span<const EntryId> around) {
  if (candidates.offsets.empty()) candidates.offsets.push_back(0);
  std::vector<EntryId> added, all;
  forRows(pairs, [&](std::span<const SlaveMaster> row) {
    const EntryId slave = row.front().slave;
    assert(std::ranges::binary_search(around, slave));
    const std::span<const EntryId> former = candidates.mastersOf(slave);
    added.clear(), all.clear();
    for (const SlaveMaster& pair : row) added.push_back(pair.master);
    std::ranges::set_union(former, added, std::back_inserter(all));
    if (all.size() == former.size()) return;
    candidates.slaves.push_back(slave);
    candidates.masters.insert(candidates.masters.end(), all.begin(), all.end());
    candidates.offsets.push_back(static_cast<std::uint32_t>(candidates.masters.size()));
  });
  candidates.index();
  if (!candidates.distances.empty()) candidates.distances.resize(candidates.slaves.size());
  for (const EntryId entry : around)
    if (const std::uint32_t row = candidates.rowOf(entry); row < candidates.distances.size())
      candidates.distances[row] = {};
  candidates.nearest = {};
}

void removeGone(Candidates& candidates, const ContactSurfaces& surfaces) {
  std::vector<SlaveMaster> kept;
  for (const std::uint32_t r : candidates.rows()) {
    if (surfaces.isGone(candidates.slaves[r])) continue;
    for (const EntryId master : candidates.mastersOfRow(r))
      if (!surfaces.isGone(master)) kept.push_back({candidates.slaves[r], master});
  }
  replaceCandidates(candidates, kept, surfaces.entries());
}

}  // namespace yadefrag
