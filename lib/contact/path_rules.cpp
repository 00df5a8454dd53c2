#include "contact/path_rules.hpp"

#include <algorithm>

#include "contact/entry_path.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// One slave's way through the step.
template <class Geometry>
class Path {
 public:
  Path(const ContactSurfaces& surfaces, const Geometry& now, const PathStart& start, EntryId slave)
      : surfaces_(surfaces),
        now_(now),
        before_(surfaces, start.positions),
        start_(start),
        slave_(slave),
        from_(before_.slave(slave)),
        to_(now.slave(slave)) {}

  /// Has it come into a piece that it is behind now.
  [[nodiscard]] bool enters(const Trial& trial, double deepest) const {
    const EntryId master = trial.master;
    if (isTouched(master) && staysOver(trial)) return true;
    if (!now_.isArc(master)) return crosses(master);
    return isOver(now_, master, trial.foot) && trial.foot.gap >= -deepest &&
           before_.foot(master, from_).gap >= -start_.depth;
  }

 private:
  [[nodiscard]] bool isTouched(EntryId master) const {
    return std::ranges::binary_search(start_.touches, SlaveMaster{slave_, master}, {},
                                      &Touch::pair);
  }

  /// Is ξ (0 at the begin of a piece, 1 at its end) over it, or, at a concave joint, not farther
  /// past it than a slave `depth` (m) behind the piece may be inside a notch.
  [[nodiscard]] bool isWithin(EntryId master, double xi, double length, double depth) const {
    const double past = tolerance::kPastConcave * depth / length;
    const double least = isConcave(surfaces_.prev[master.value], master) ? past : 0;
    const double most = isConcave(master, surfaces_.next[master.value]) ? past : 0;
    return xi >= -least - tolerance::kFootRange && xi <= 1 + most + tolerance::kFootRange;
  }

  [[nodiscard]] bool staysOver(const Trial& trial) const {
    if (now_.isArc(trial.master)) return isOver(now_, trial.master, trial.foot);
    const PieceRange range = now_.range(trial.master);
    const PieceEnds ends = now_.ends(trial.master);
    return isWithin(trial.master, (trial.foot.xi - range.begin) / (range.end - range.begin),
                    norm(ends.end - ends.begin), -trial.foot.gap);
  }

  [[nodiscard]] bool crosses(EntryId master) const {
    const PieceEnds ends = now_.ends(master);
    const auto at = crossing({from_, before_.ends(master)}, {to_, ends}, start_.depth);
    return at && isWithin(master, at->xi, norm(ends.end - ends.begin), start_.depth);
  }

  [[nodiscard]] bool isConcave(EntryId first, EntryId second) const {
    return isConcaveJoint(now_, first, second);
  }

  const ContactSurfaces& surfaces_;
  const Geometry& now_;
  Geometry before_;
  const PathStart& start_;
  EntryId slave_;
  Vec2 from_, to_;
};

}  // namespace

template <class Geometry>
void decideByPath(const ContactSurfaces& surfaces, const Geometry& geometry, const PathStart& start,
                  EntryId slave, std::span<Trial> trials, double deepest) {
  const Path<Geometry> path(surfaces, geometry, start, slave);
  for (Trial& trial : trials)
    trial.outside = trial.active =
        trial.opposed && trial.foot.gap < 0 && path.enters(trial, deepest);
  decideJoints(surfaces, geometry, trials);
}

template void decideByPath(const ContactSurfaces&, const PieceGeometryOf<true>&, const PathStart&,
                           EntryId, std::span<Trial>, double);
template void decideByPath(const ContactSurfaces&, const PieceGeometryOf<false>&, const PathStart&,
                           EntryId, std::span<Trial>, double);

}  // namespace yadefrag
