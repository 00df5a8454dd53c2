#include "contact/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// Walks through the rows of the former candidates in the order in which new pairs come.
class FormerFlags {
 public:
  explicit FormerFlags(const Candidates& former) : former_(former) {}

  /// The flag of a pair, or `unknown` if it was no candidate.
  std::uint8_t find(const SlaveMaster& pair, std::uint8_t unknown) {
    while (row_ < former_.slaves.size() && former_.slaves[row_] < pair.slave)
      at_ = former_.offsets[++row_];
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

/// The pairs, ascending, as rows; returns what was there before.
Candidates fill(Candidates& candidates, const std::vector<SlaveMaster>& pairs,
                const ContactSurfaces& surfaces, std::span<const Vec2> before) {
  constexpr std::uint8_t kUnknown = 2;
  const PieceGeometry geometry(surfaces, before);
  FormerFlags former(candidates);
  Candidates next;
  next.masters.reserve(pairs.size());
  next.outside.reserve(pairs.size());
  for (const SlaveMaster& pair : pairs) {
    if (next.slaves.empty() || next.slaves.back() != pair.slave) {
      next.slaves.push_back(pair.slave);
      next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
    }
    std::uint8_t outside = former.find(pair, kUnknown);
    if (outside == kUnknown) {
      const Vec2 slave = geometry.slave(pair.slave);
      const double touching =
          std::max(tolerance::kTouching * geometry.length(pair.master),
                   tolerance::kTouchRounding * std::max(std::abs(slave.x), std::abs(slave.y)));
      outside = geometry.foot(pair.master, slave).gap >= -touching ? 1 : 0;
    }
    next.masters.push_back(pair.master);
    next.outside.push_back(outside);
  }
  next.offsets.push_back(static_cast<std::uint32_t>(next.masters.size()));
  std::swap(candidates, next);
  return next;
}

}  // namespace

void Candidates::clear() { *this = {}; }

void addCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                   const ContactSurfaces& surfaces, std::span<const Vec2> before) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<SlaveMaster> former, all;
  former.reserve(candidates.size());
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c)
      former.push_back({candidates.slaves[r], candidates.masters[c]});
  all.reserve(former.size() + pairs.size());
  std::set_union(former.begin(), former.end(), pairs.begin(), pairs.end(), std::back_inserter(all));
  fill(candidates, all, surfaces, before);
}

Candidates replaceCandidates(Candidates& candidates, std::vector<SlaveMaster>& pairs,
                             const ContactSurfaces& surfaces, std::span<const Vec2> before) {
  std::sort(pairs.begin(), pairs.end());
  return fill(candidates, pairs, surfaces, before);
}

void removeGone(Candidates& candidates, const ContactSurfaces& surfaces) {
  Candidates left;
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r) {
    if (surfaces.isGone(candidates.slaves[r])) continue;
    const auto begin = static_cast<std::uint32_t>(left.masters.size());
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      if (surfaces.isGone(candidates.masters[c])) continue;
      left.masters.push_back(candidates.masters[c]);
      left.outside.push_back(candidates.outside[c]);
    }
    if (left.masters.size() == begin) continue;
    left.slaves.push_back(candidates.slaves[r]);
    left.offsets.push_back(begin);
  }
  left.offsets.push_back(static_cast<std::uint32_t>(left.masters.size()));
  candidates = std::move(left);
}

}  // namespace yadefrag
