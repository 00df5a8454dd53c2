// Data of contact that are stored from one step to the next.

#include <algorithm>
#include <utility>

#include "contact/contact.hpp"

namespace yadefrag {

namespace {

/// With new numbers, and without contacts of removed entries.
std::vector<Touch> renumbered(std::vector<Touch> touches, std::span<const EntryId> numbers) {
  for (Touch& touch : touches)
    touch.pair = {numbers[touch.pair.slave.value], numbers[touch.pair.master.value]};
  std::erase_if(touches, [](const Touch& touch) {
    return touch.pair.slave == EntryId::none() || touch.pair.master == EntryId::none();
  });
  std::ranges::sort(touches, {}, &Touch::pair);
  return touches;
}

/// Only the flags are needed until the next search.
Candidates renumbered(const Candidates& candidates, std::span<const EntryId> numbers) {
  std::vector<std::pair<SlaveMaster, std::uint8_t>> flags;
  for (std::size_t r = 0; r < candidates.slaves.size() && !candidates.outside.empty(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      const SlaveMaster pair{numbers[candidates.slaves[r].value],
                             numbers[candidates.masters[c].value]};
      if (pair.slave != EntryId::none() && pair.master != EntryId::none())
        flags.emplace_back(pair, candidates.outside[c]);
    }
  Candidates kept;
  if (flags.empty()) return kept;
  std::ranges::sort(flags);
  for (const auto& [pair, outside] : flags) {
    if (kept.slaves.empty() || kept.slaves.back() != pair.slave) {
      kept.slaves.push_back(pair.slave);
      kept.offsets.push_back(static_cast<std::uint32_t>(kept.masters.size()));
    }
    kept.masters.push_back(pair.master), kept.outside.push_back(outside);
  }
  kept.offsets.push_back(static_cast<std::uint32_t>(kept.masters.size()));
  return kept;
}

}  // namespace

/// (m) Largest depth at xⁿ of the contacts of the last step.
double Contact::deepestTouch(const ContactSurfaces& surfaces, std::span<const Vec2> before) const {
  double most = 0;
  withGeometry(surfaces, before, [&](const auto& geometry) {
    for (const Touch& touch : touches)
      most =
          std::max(most, -geometry.foot(touch.pair.master, geometry.slave(touch.pair.slave)).gap);
  });
  return most;
}

void Contact::renumber(std::span<const EntryId> numbers) {
  std::vector<Touch> keptTouches = renumbered(std::move(touches), numbers);
  Candidates keptCandidates = renumbered(candidates, numbers);
  reset();
  touches = std::move(keptTouches), candidates = std::move(keptCandidates);
}

void Contact::removeGone(const ContactSurfaces& surfaces) {
  yadefrag::removeGone(candidates, surfaces);
  std::erase_if(touches, [&](const Touch& t) {
    return surfaces.isGone(t.pair.slave) || surfaces.isGone(t.pair.master);
  });
}

void Contact::allowOverlaps(const ContactSurfaces& surfaces, std::span<const Vec2> positions,
                            std::span<const EntryId> masters, std::span<const SlaveMaster> pairs) {
  if (masters.empty() && pairs.empty()) return;
  const PieceGeometry geometry(surfaces, positions);
  for (std::size_t r = 0; r < candidates.slaves.size(); ++r)
    for (std::uint32_t c = candidates.offsets[r]; c < candidates.offsets[r + 1]; ++c) {
      const SlaveMaster pair{candidates.slaves[r], candidates.masters[c]};
      if (!candidates.outside.empty() && candidates.outside[c] == 0) continue;
      if (std::ranges::find(masters, pair.master) == masters.end() &&
          !std::ranges::binary_search(pairs, pair))
        continue;
      const Foot foot = geometry.foot(pair.master, geometry.slave(pair.slave));
      const double gap = foot.gap;
      if (gap >= 0) continue;
      // Without flags: a change of shape is a fraction of a piece's length only.
      if (candidates.outside.empty() &&
          (!isOver(geometry, pair.master, foot) || gap < -.25 * geometry.length(pair.master)))
        continue;
      const auto at =
          std::lower_bound(touches.begin(), touches.end(), pair,
                           [](const Touch& t, const SlaveMaster& p) { return t.pair < p; });
      if (at != touches.end() && at->pair == pair)
        at->toleratedGap = std::min(at->toleratedGap, gap);
      else
        touches.insert(at, {pair, 0, 0, gap});
    }
}

}  // namespace yadefrag
