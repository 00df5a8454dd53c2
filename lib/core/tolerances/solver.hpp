#pragma once
// Tolerances and thresholds of the forces of contact, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (relative to the largest bound) Change of the friction bounds at which their iteration ends, and
/// how often it may go round.
inline constexpr double kFrictionBound = 1e-4;
inline constexpr int kFrictionRounds = 8;

/// (count; of the largest displacement in the step) Contact in rubble is solved by so many sweeps
/// at each of so many detections, until they change so little. What is left is to be less than
/// kEntryDepth. With 2 detections and ten times the change an impact takes 0.9 of the time, and
/// pieces overlap by up to 4e-4 of a segment; with 10 detections of 400 sweeps and a hundredth of
/// the change, 4 times the time, and overlaps are below 2e-5.
inline constexpr int kRowSweeps = 20, kRubbleDetections = 4;
inline constexpr double kRubbleRemainder = 1e-4;

/// (rows; of the penetration that is worth another solve; count) A group with friction and more
/// rows than the first is solved by sweeps, until no gap or slip changes by more than the second,
/// or for so many sweeps.
inline constexpr std::size_t kPivotedRows = 8;
inline constexpr double kSweptChange = .1;
inline constexpr int kGroupSweeps = 200;

/// (ratio) Normal forces above this many times the largest that one row of their group needs by
/// itself are a jam's, and bound friction no further.
inline constexpr double kJam = 100;

/// (relative to max |g|) Error of the forces of a contact group, besides rounding: below what the
/// linearisation leaves. Smaller ones cost Gauss–Seidel sweeps in two-pass systems with friction.
inline constexpr double kBoxResidual = 1e-9;

/// (of the sum of the parts of a gap) What rounding may make of a gap of a group.
inline constexpr double kGapRounding = 0x1p-48;

/// (of the product of their diagonals) Two rows with a determinant above this are solved in closed
/// form.
inline constexpr double kIndependentRows = 1e-6;

/// (relative to the diagonal) Proximal regularisation of a group's matrix; the next where pivoting
/// cycles with the one before.
inline constexpr double kProximal[] = {1e-7, 1e-5, 1e-3};

/// (relative to the diagonal; count) The same for a group that has no solution, and how often it is
/// taken out again: a force grows by 1/(2ε) of what would close the gap each time.
inline constexpr double kCompromise = 1e-2;
inline constexpr int kCompromiseSteps = 5;

/// (relative to max |g|) A bound or a sign violated by less than this is no reason for a pivot.
inline constexpr double kPivotSlack = 1e-15;

/// (count) Pivots of all contradicted rows at once that may fail to reduce their number.
inline constexpr int kBlocksWithoutGain = 3;

/// (part of a Newton step) Below this a step that lowers the energy is lost in rounding.
inline constexpr double kLeastDescent = 1e-9;

/// (ratio) Part of the fall that the slope promises, with which a step is content.
inline constexpr double kArmijo = 1e-4;

/// (count) Factors of one solve after which the next regularisation is tried.
inline constexpr int kMostPivots = 300;

/// (count) Proximal iterations, and how many of them must at least halve the error.
inline constexpr int kMostRefinements = 200, kRefinementsToHalve = 10;

/// (count) Gauss–Seidel sweeps where all else fails, and between two looks at the error.
inline constexpr int kMostSweeps = 100, kSweepsToCheck = 10;

/// (rows) Up to the first a group's matrix is factored by plain loops, up to the second as a dense
/// one; up to the third if more than a quarter of its entries are there.
inline constexpr std::size_t kPlainCholesky = 16, kDenseRows = 32, kMostDenseRows = 1500;

}  // namespace yadefrag::tolerance
