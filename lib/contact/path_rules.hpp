#pragma once
// Entry: a slave is active on a piece that its path from xⁿ to its present position crosses.
//
// The paper stores a flag for each slave and master instead (fig. 8): true if the slave was in
// front of the master's line (A), false if it was behind it (B); only a slave with the flag may
// enter. Here no flags are needed. A slave that is behind a piece by no more than `depth` at xⁿ
// counts as in front of it: rounding and unfinished corrections leave less. Only an active of the
// previous step keeps its piece at any depth.
//
//     void          p0            The gap to the moving piece is a quadratic in time. The slave
//     ──────────────●─ line       enters at the time at which it falls below −depth, or at the end
//     body           ╲            of the step. The position on the piece at that time is decisive,
//                     p*          also if the slave passes through a thin body or past an end.
//
// Junctions: of two actives at a convex junction the nearer one is kept; at a concave one, a slave
// past both ends is inside, and both are active (paper §5.2).

#include <span>

#include "contact/junction_rules.hpp"
#include "contact/touch.hpp"

namespace yadefrag {

/// Data of the previous step. The arrays must outlive the search.
struct PathStart {
  std::span<const Vec2> positions;  ///< m, xⁿ, by node; of surface nodes only
  std::span<const Touch> touches;   ///< by pair
  double depth = 0;                 ///< m, depth from which a slave counts as behind a line
  double deepest = 0;               ///< m, largest depth of the touches
  tolerance::Contact constants = {};
};

/// The step of one slave.
template <class Geometry>
struct SlaveStep {
  const Geometry &before, &now;
  EntryId slave;
  std::span<const Touch> touches;  ///< stored contacts of the slave
  double depth;                    ///< m, as in PathStart
  const tolerance::Contact& constants;
};

/// Sets `active` for the masters that a slave has entered; returns true if there are any. Depths in
/// a smooth master beyond `deepest` (m) are ignored.
template <class Geometry>
bool findEntered(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                 std::span<Trial> trials, double deepest);

/// Then selects, among all masters behind which the slave is, those on which it is active.
template <class Geometry>
void decideByPath(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                  std::span<Trial> trials);

}  // namespace yadefrag
