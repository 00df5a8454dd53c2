#include "contact/path_rules.hpp"

#include <algorithm>

#include "contact/crossing.hpp"
#include "contact/slave_normals.hpp"
#include "core/tolerances/contact.hpp"

namespace yadefrag {

namespace {

/// The path of one slave in the step.
template <class Geometry>
class Path {
 public:
  Path(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step)
      : surfaces_(surfaces),
        step_(step),
        now_(step.now),
        from_(step.before.slave(step.slave)),
        to_(step.now.slave(step.slave)) {}

  /// True if the slave has entered a piece behind which it is now. Computes the trial's foot if
  /// needed.
  [[nodiscard]] bool enters(Trial& trial, double deepest) const {
    const EntryId master = trial.master;
    const bool arc = now_.isArc(master), touched = isTouched(master);
    if (arc || touched) findFoot(trial);
    if (touched && trial.foot.gap < 0 && staysOver(trial)) return true;
    if (!arc) return crosses(master);
    return isOver(now_, master, trial.foot) && trial.foot.gap < 0 && trial.foot.gap >= -deepest &&
           step_.before.foot(master, from_).gap >= -step_.depth;
  }

  void findFoot(Trial& trial) const {
    if (trial.hasFoot) return;
    trial.foot = now_.foot(trial.master, to_);
    trial.hasFoot = true;
  }

 private:
  [[nodiscard]] bool isTouched(EntryId master) const {
    return touchOn(step_.touches, master) != nullptr;
  }

  /// True if ξ (0 at the begin of a piece, 1 at its end) is over the piece, or, at a concave
  /// junction, no farther past it than a slave `depth` (m) behind the piece may be inside a notch.
  [[nodiscard]] bool isWithin(EntryId master, double xi, double length, double depth) const {
    const double past = step_.constants.pastConcave * depth / length;
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
    const auto at = crossing({from_, step_.before.ends(master)}, {to_, ends}, step_.depth);
    return at && isWithin(master, at->xi, norm(ends.end - ends.begin), step_.depth);
  }

  [[nodiscard]] bool isConcave(EntryId first, EntryId second) const {
    return isConcaveJunction(now_, first, second);
  }

  const ContactSurfaces& surfaces_;
  const SlaveStep<Geometry>& step_;
  const Geometry& now_;
  Vec2 from_, to_;
};

}  // namespace

template <class Geometry>
bool findEntered(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                 std::span<Trial> trials, double deepest) {
  const Path<Geometry> path(surfaces, step);
  bool any = false;
  for (Trial& trial : trials) {
    trial.active = path.enters(trial, deepest);
    any = any || trial.active;
  }
  return any;
}

template <class Geometry>
void decideByPath(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                  std::span<Trial> trials) {
  const Path<Geometry> path(surfaces, step);
  const SlaveNormals normals = slaveNormals(surfaces, step.now, step.slave);
  for (Trial& trial : trials) {
    path.findFoot(trial);
    trial.opposed = normals.oppose(trial.foot.normal, step.constants);
    trial.active = trial.active && trial.opposed && trial.foot.gap < 0;
    trial.entered = trial.active;
  }
  decideJunctions(surfaces, step.now, trials);
}

template bool findEntered(const ContactSurfaces&, const SlaveStep<PieceGeometryOf<true>>&,
                          std::span<Trial>, double);
template bool findEntered(const ContactSurfaces&, const SlaveStep<PieceGeometryOf<false>>&,
                          std::span<Trial>, double);
template void decideByPath(const ContactSurfaces&, const SlaveStep<PieceGeometryOf<true>>&,
                           std::span<Trial>);
template void decideByPath(const ContactSurfaces&, const SlaveStep<PieceGeometryOf<false>>&,
                           std::span<Trial>);

}  // namespace yadefrag
