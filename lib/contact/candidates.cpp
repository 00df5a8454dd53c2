#include "contact/candidates.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace yadefrag {

namespace {

/// Stores the pairs, ascending, as rows; returns the former candidates.
Candidates fill(Candidates& candidates, const std::vector<SlaveMaster>& pairs) {
  assert(std::is_sorted(pairs.begin(), pairs.end()));
  Candidates next;
  next.masters.reserve(pairs.size());
  for (const SlaveMaster& pair : pairs) {
    if (next.slaves.empty() || next.slaves.back() != pair.slave) {
      next.slaves.push_back(pair.slave);
      next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
    }
    next.masters.push_back(pair.master);
  }
  next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
  std::swap(candidates, next);
  return next;
}

}  // namespace

void Candidates::clear() { *this = {}; }

void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<SlaveMaster> former, all;
  former.reserve(candidates.size());
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c)
      former.push_back({candidates.slaves[r], candidates.masters[c]});
  all.reserve(former.size() + pairs.size());
  std::set_union(former.begin(), former.end(), pairs.begin(), pairs.end(), std::back_inserter(all));
  fill(candidates, all);
}

Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  return fill(candidates, pairs);
}

void removeGone(Candidates& candidates, const ContactSurfaces& surfaces) {
  Candidates kept;
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r) {
    if (surfaces.isGone(candidates.slaves[r])) continue;
    const auto begin = static_cast<std::uint32_t>(kept.masters.size());
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c)
      if (!surfaces.isGone(candidates.masters[c])) kept.masters.push_back(candidates.masters[c]);
    if (kept.masters.size() == begin) continue;
    kept.slaves.push_back(candidates.slaves[r]);
    kept.offsets.push_back(begin);
  }
  kept.offsets.push_back(static_cast<std::uint32_t>(kept.masters.size()));
  candidates = std::move(kept);
}

}  // namespace yadefrag
