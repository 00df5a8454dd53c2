#pragma once
// Entry by the path: a slave is active on a piece that its path from xⁿ to where it is now crosses.
//
// Nothing has to be remembered about sides. A slave that is behind a piece by no more than `depth`
// at xⁿ counts as before it: what rounding and unfinished corrections leave is less. Only what was
// active in the step before keeps its piece, however deep it is.
//
//     void          p0            The gap to the moving piece is a quadratic in time. The slave
//     ──────────────●─ line       enters at the time at which it falls below −depth, or at the end
//     body           ╲            of the step; over which piece it is then decides, also where it
//                     p*          goes through a thin body or past an end within the step.
//
// Joints: at a convex one of two actives the nearer one holds; at a concave one, what is past both
// ends is inside, and both hold it (paper §5.2).

#include <span>

#include "contact/joint_rules.hpp"
#include "contact/touch.hpp"

namespace yadefrag {

/// The step before, as entry by the path needs it. It must outlive the search.
struct PathStart {
  std::span<const Vec2> positions;  ///< m, xⁿ, by node; of surface nodes only
  std::span<const Touch> touches;   ///< by pair
  double depth = 0;                 ///< m, at which a slave is behind a line
  double deepest = 0;               ///< m, of the touches
};

/// One slave's step.
template <class Geometry>
struct SlaveStep {
  const Geometry &before, &now;
  EntryId slave;
  std::span<const Touch> touches;  ///< of the slave
  double depth;                    ///< m, as in PathStart
};

/// Sets `active` of the masters that a slave has come into; is there any. Nothing is deeper in a
/// smooth master than `deepest` (m).
template <class Geometry>
bool findEntered(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                 std::span<Trial> trials, double deepest);

/// Then, among all masters that it is behind: on which of them it is active.
template <class Geometry>
void decideByPath(const ContactSurfaces& surfaces, const SlaveStep<Geometry>& step,
                  std::span<Trial> trials);

}  // namespace yadefrag
