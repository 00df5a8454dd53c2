#pragma once
// Tolerances and thresholds of the forces of contact, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (relative to the largest bound; count) The iteration of the friction bounds ends at this change,
/// or after this number of rounds.
inline constexpr double kFrictionBound = 1e-4;
inline constexpr int kFrictionRounds = 8;

/// (count; of the largest displacement in the step; of that) Rubble is detected at most this number
/// of times in a step, and again only if a penetration exceeds the second value; see also
/// Contact::rowSweeps. Sweeps end as soon as none changes a gap or a slip by more than the third.
/// Median overlap of 48 impacts (of a segment), and number of visits to a row: 4e-5 and 1 with 1e-4
/// and 1; 5e-5 and .55 with these values; 1.2e-4 and .15 with 1e-3 and 1. With 10 detections
/// overlaps are the same, for 1.3 times the time.
inline constexpr int kRubbleDetections = 4;
inline constexpr double kRubbleRemainder = 1e-3, kRubbleChange = .3;

/// (count) Sweeps of contact to one of the cohesive tractions at the same nodes. A block that
/// breaks on a wall takes 1.9 times the time with 1, 1.45 times with 4, 8 or more, of that without
/// common sweeps; `contact` falls by at most 2e-5 of the energy with 4, 1.6e-4 with 16.
inline constexpr int kSweepsToCouple = 4;

/// (rows; of the penetration that needs another solution; count) A group with friction and more
/// rows than the first value is solved by sweeps, until no gap or slip changes by more than the
/// second, or after this number of sweeps. With a rigid body that obeys forces, sweeps need some
/// multiple of the ratio of the nodes' mass to the body's: pivoting is used up to more rows.
inline constexpr std::size_t kPivotedRows = 8, kPivotedRigidRows = 64;
inline constexpr double kSweptChange = .1;
inline constexpr int kGroupSweeps = 200;

/// (ratio) Normal forces above this multiple of the largest force that one row of their group needs
/// alone result from a jam. They are not used to increase friction bounds.
inline constexpr double kJam = 100;

/// (relative to max |g|) Residual of the forces of a contact group, besides rounding; it is below
/// the error of the linearisation. A smaller value costs Gauss–Seidel sweeps in two-pass systems
/// with friction.
inline constexpr double kBoxResidual = 1e-9;

/// (of the sum of the absolute parts of a gap) Rounding error of a gap of a group.
inline constexpr double kGapRounding = 0x1p-48;

/// (of the product of their diagonals) Two rows whose determinant exceeds this are solved in closed
/// form.
inline constexpr double kIndependentRows = 1e-6;

/// (relative to the diagonal) Proximal regularisations of a group's matrix; the next larger one is
/// used if pivoting cycles with the one before.
inline constexpr double kProximal[] = {1e-7, 1e-5, 1e-3};

/// (relative to the diagonal; count) Proximal regularisation of a group without a solution, and
/// number of refinements that reduce its effect: each increases a force by 1/(2ε) of what would
/// close the gap.
inline constexpr double kCompromise = 1e-2;
inline constexpr int kCompromiseSteps = 5;

/// (relative to max |g|) A violation of a bound or of a sign below this does not cause a pivot.
inline constexpr double kPivotSlack = 1e-15;

/// (count) Number of block pivots (all contradicted rows at once) that may fail to reduce the
/// number of contradicted rows.
inline constexpr int kBlocksWithoutGain = 3;

/// (part of a Newton step) A descent step below this is smaller than rounding.
inline constexpr double kLeastDescent = 1e-9;

/// (ratio) Armijo's condition: a step must reach at least this part of the decrease that the slope
/// predicts.
inline constexpr double kArmijo = 1e-4;

/// (count) Factorisations per solution; after these the next regularisation is tried.
inline constexpr int kMostPivots = 300;

/// (count) Maximum number of proximal iterations, and number of iterations in which the error must
/// at least be halved.
inline constexpr int kMostRefinements = 200, kRefinementsToHalve = 10;

/// (count) Gauss–Seidel sweeps if all other methods fail, and sweeps between two computations of
/// the error.
inline constexpr int kMostSweeps = 100, kSweepsToCheck = 10;

/// (rows) A group's matrix is factorised by plain loops up to the first size, as a dense matrix up
/// to the second, and also up to the third if more than a quarter of its entries are not zero.
inline constexpr std::size_t kPlainCholesky = 16, kDenseRows = 32, kMostDenseRows = 1500;

}  // namespace yadefrag::tolerance
