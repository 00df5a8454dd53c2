#include "contact/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// Visits the rows of the former candidates in the order of the new pairs.
class FormerFlags {
 public:
  explicit FormerFlags(const Candidates& former) : former_(former) {}

  /// The flag of a pair, or `unknown` if it was no candidate or had no flag.
  std::uint8_t find(const SlaveMaster& pair, std::uint8_t unknown) {
    while (row_ < former_.slaves.size() && former_.slaves[row_] < pair.slave)
      at_ = former_.offsets[++row_];
    if (former_.outside.empty()) return unknown;
    if (row_ == former_.slaves.size() || former_.slaves[row_] != pair.slave) return unknown;
    const std::uint32_t end = former_.offsets[row_ + 1];
    while (at_ < end && former_.masters[at_] < pair.master) ++at_;
    return at_ < end && former_.masters[at_] == pair.master ? former_.outside[at_] : unknown;
  }

 private:
  const Candidates& former_;
  std::size_t row_ = 0;
  std::uint32_t at_ = 0;
};

std::uint8_t flagAt(const PieceGeometry& geometry, const SlaveMaster& pair) {
  const Vec2 slave = geometry.slave(pair.slave);
  const double touching =
      std::max(tolerance::kTouching * geometry.length(pair.master),
               tolerance::kTouchRounding * std::max(std::abs(slave.x), std::abs(slave.y)));
  return geometry.foot(pair.master, slave).gap >= -touching ? 1 : 0;
}

/// Stores the pairs, ascending, as rows; returns the former candidates.
Candidates fill(Candidates& candidates, const std::vector<SlaveMaster>& pairs,
                const ContactSurfaces& surfaces, std::span<const Vec2> before, bool flags) {
  constexpr std::uint8_t kUnknown = 2;
  const PieceGeometry geometry(surfaces, before);
  FormerFlags former(candidates);
  Candidates next;
  next.masters.reserve(pairs.size());
  if (flags) next.outside.reserve(pairs.size());
  for (const SlaveMaster& pair : pairs) {
    if (next.slaves.empty() || next.slaves.back() != pair.slave) {
      next.slaves.push_back(pair.slave);
      next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
    }
    next.masters.push_back(pair.master);
    if (!flags) continue;
    const std::uint8_t outside = former.find(pair, kUnknown);
    next.outside.push_back(outside == kUnknown ? flagAt(geometry, pair) : outside);
  }
  next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
  std::swap(candidates, next);
  return next;
}

}  // namespace

void Candidates::clear() { *this = {}; }

void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   const ContactSurfaces& surfaces, std::span<const Vec2> before, bool flags) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<SlaveMaster> former, all;
  former.reserve(candidates.size());
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c)
      former.push_back({candidates.slaves[r], candidates.masters[c]});
  all.reserve(former.size() + pairs.size());
  std::set_union(former.begin(), former.end(), pairs.begin(), pairs.end(), std::back_inserter(all));
  fill(candidates, all, surfaces, before, flags);
}

Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             const ContactSurfaces& surfaces, std::span<const Vec2> before,
                             bool flags) {
  std::sort(pairs.begin(), pairs.end());
  return fill(candidates, pairs, surfaces, before, flags);
}

void keepFlags(Candidates& candidates, const ContactSurfaces& surfaces,
               std::span<const Vec2> before, bool keep) {
  if (!keep) return candidates.outside.clear();
  if (candidates.outside.size() == candidates.masters.size()) return;
  const PieceGeometry geometry(surfaces, before);
  candidates.outside.clear();
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c)
      candidates.outside.push_back(flagAt(geometry, {candidates.slaves[r], candidates.masters[c]}));
}

void removeGone(Candidates& candidates, const ContactSurfaces& surfaces) {
  Candidates kept;
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r) {
    if (surfaces.isGone(candidates.slaves[r])) continue;
    const auto begin = static_cast<std::uint32_t>(kept.masters.size());
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      if (surfaces.isGone(candidates.masters[c])) continue;
      kept.masters.push_back(candidates.masters[c]);
      if (!candidates.outside.empty()) kept.outside.push_back(candidates.outside[c]);
    }
    if (kept.masters.size() == begin) continue;
    kept.slaves.push_back(candidates.slaves[r]);
    kept.offsets.push_back(begin);
  }
  kept.offsets.push_back(static_cast<std::uint32_t>(kept.masters.size()));
  candidates = std::move(kept);
}

}  // namespace yadefrag
