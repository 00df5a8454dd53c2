// Data of contact that are stored from one step to the next.

#include <algorithm>

#include "contact/contact.hpp"

namespace yadefrag {

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
