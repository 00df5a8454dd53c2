#include "contact/junction_rules.hpp"

namespace yadefrag {

namespace {

template <class Geometry>
bool isBehindEnd(const Geometry& geometry, EntryId master, const Foot& foot) {
  return foot.xi > geometry.range(master).end;
}
template <class Geometry>
bool isBeforeBegin(const Geometry& geometry, EntryId master, const Foot& foot) {
  return foot.xi < geometry.range(master).begin;
}

/// `second` follows `first` on their surface.
template <class Geometry>
void decideNeighbours(const Geometry& geometry, Trial& first, Trial& second) {
  const bool pastFirst = isBehindEnd(geometry, first.master, first.foot);
  const bool pastSecond = isBeforeBegin(geometry, second.master, second.foot);
  const bool concave = isConcaveJunction(geometry, first.master, second.master);
  if (concave && pastFirst && pastSecond) {
    // No orthogonal correction is possible: correct to the corner, by the rows of both masters. In
    // a notch narrower than a right angle the slave may be behind one of them only.
    const bool both = first.foot.gap < 0 && second.foot.gap < 0;
    const bool anyEntered = first.entered || second.entered;
    for (Trial* trial : {&first, &second})
      if (trial->foot.gap < 0 && (both ? anyEntered : trial->entered))
        trial->active = trial->opposed;
  } else if (!concave && first.active && second.active) {
    const bool firstIsNearer = first.foot.gap >= second.foot.gap;
    (firstIsNearer ? second : first).active = false;
  }
}

}  // namespace

template <class Geometry>
void decideJunctions(const ContactSurfaces& surfaces, const Geometry& geometry,
                     std::span<Trial> trials) {
  for (Trial& first : trials) {
    const EntryId after = surfaces.next[first.master.value];
    for (Trial& second : trials)
      if (second.master == after) decideNeighbours(geometry, first, second);
  }
}

template void decideJunctions(const ContactSurfaces&, const PieceGeometryOf<true>&,
                              std::span<Trial>);
template void decideJunctions(const ContactSurfaces&, const PieceGeometryOf<false>&,
                              std::span<Trial>);

}  // namespace yadefrag
