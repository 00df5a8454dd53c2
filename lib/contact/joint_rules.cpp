#include "contact/joint_rules.hpp"

#include "core/tolerances/contact.hpp"

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

/// A slave that was outside `from` is now inside `to`, whose flag has the value that it was behind
/// its line before. It entered past the end of `from`, along which it may have slid; or, as a
/// corner that grazes a corner, through `from` itself, a lateral face to which it is not opposed. A
/// sliding point is not deeper than its displacement in the step.
void enterFromNeighbour(const Trial& from, Trial& to, bool pastFrom, double reach) {
  if (!from.outside || !to.opposed || to.active || to.foot.gap >= 0) return;
  if (!pastFrom && (from.opposed || from.foot.gap >= 0)) return;
  if (pastFrom && to.foot.gap < -2 * reach) return;
  to.active = true;
}

/// `second` follows `first` on their surface.
template <class Geometry>
void enterAtJoint(const Geometry& geometry, Trial& first, Trial& second, double deepest,
                  double reach) {
  const bool overFirst = isOver(geometry, first.master, first.foot);
  const bool overSecond = isOver(geometry, second.master, second.foot);
  const bool pastFirst = isBehindEnd(geometry, first.master, first.foot);
  const bool pastSecond = isBeforeBegin(geometry, second.master, second.foot);
  if (overSecond && second.foot.gap >= -deepest && (pastFirst || overFirst))
    enterFromNeighbour(first, second, pastFirst, reach);
  if (overFirst && first.foot.gap >= -deepest && (pastSecond || overSecond))
    enterFromNeighbour(second, first, pastSecond, reach);
}

/// `second` follows `first` on their surface.
template <class Geometry>
void decideNeighbours(const Geometry& geometry, Trial& first, Trial& second) {
  const bool pastFirst = isBehindEnd(geometry, first.master, first.foot);
  const bool pastSecond = isBeforeBegin(geometry, second.master, second.foot);
  const bool concave = isConcaveJoint(geometry, first.master, second.master);
  if (concave && pastFirst && pastSecond) {
    // No orthogonal correction is possible: correct to the corner, by the rows of both masters. In
    // a notch narrower than a right angle the slave may be behind one of them only.
    const bool both = first.foot.gap < 0 && second.foot.gap < 0;
    const bool wasOutside = first.outside || second.outside;
    for (Trial* trial : {&first, &second})
      if (trial->foot.gap < 0 && (both ? wasOutside : trial->outside))
        trial->active = trial->opposed;
  } else if (!concave && first.active && second.active) {
    const bool firstIsNearer = first.foot.gap >= second.foot.gap;
    (firstIsNearer ? second : first).active = false;
  }
}

}  // namespace

/// The outside-inside criterion (§5.1), then the exceptions where two masters meet (§5.2). A smooth
/// master needs no flag (§5.3): its normal always exists and is unique. But where a body folds up,
/// the normals of a tight arc pass through the body and leave it at the other side: depths beyond
/// `deepest` are ignored.
template <class Geometry>
void JointRules::decide(const ContactSurfaces& surfaces, const Geometry& geometry,
                        std::span<Trial> trials, double deepest, double reach) {
  for (Trial& trial : trials) {
    const bool arc = geometry.isArc(trial.master);
    trial.active = trial.opposed && trial.foot.gap < 0 && (arc || trial.outside) &&
                   (!arc || trial.foot.gap >= -deepest) &&
                   isOver(geometry, trial.master, trial.foot);
  }
  // All slaves that entered past an end, before any choice: otherwise one of two adjacent pieces
  // would activate again a slave that is nearer to the other one.
  joints_.clear();
  for (std::uint32_t i = 0; i < trials.size(); ++i) {
    const EntryId after = surfaces.next[trials[i].master.value];
    for (std::uint32_t k = 0; k < trials.size(); ++k)
      if (trials[k].master == after) joints_.emplace_back(i, k);
  }
  for (const auto& [i, k] : joints_) enterAtJoint(geometry, trials[i], trials[k], deepest, reach);
  for (const auto& [i, k] : joints_) decideNeighbours(geometry, trials[i], trials[k]);
}

template <class Geometry>
void decideJoints(const ContactSurfaces& surfaces, const Geometry& geometry,
                  std::span<Trial> trials) {
  for (Trial& first : trials) {
    const EntryId after = surfaces.next[first.master.value];
    for (Trial& second : trials)
      if (second.master == after) decideNeighbours(geometry, first, second);
  }
}

template void decideJoints(const ContactSurfaces&, const PieceGeometryOf<true>&, std::span<Trial>);
template void decideJoints(const ContactSurfaces&, const PieceGeometryOf<false>&, std::span<Trial>);
template void JointRules::decide(const ContactSurfaces&, const PieceGeometryOf<true>&,
                                 std::span<Trial>, double, double);
template void JointRules::decide(const ContactSurfaces&, const PieceGeometryOf<false>&,
                                 std::span<Trial>, double, double);

}  // namespace yadefrag
