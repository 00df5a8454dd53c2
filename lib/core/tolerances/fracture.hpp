#pragma once
// Tolerances and thresholds of cracks, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (rad) A node whose triangles fill a larger angle is the tip of a notch or a crack. A straight
/// boundary fills π; a deformed or rounded one some degrees more.
inline constexpr double kTipAngle = 3.46;

/// Shear counts at a tip if the edge is nearer its strength than this times each other edge there
/// by its pull. At the tip of a crack that slides in solid material the largest pull, 70° off,
/// is 1.15 times the shear ahead: there the crack must turn. With 1.5 one of five meshes of
/// Kalthoff's test cracks at 58° instead of 65°.
inline constexpr double kShearLead = 3;

/// (elements) Minimum number of elements along the cohesive zone: by the load of a notched beam
/// (notched_beam_test.cpp).
inline constexpr double kZoneElements = 4;

/// (of the smallest width of the body) Length of the cohesive zone up to which the strength of a
/// body without a notch is that of its material, to a seventh or so (docs/data/cracks.csv).
inline constexpr double kMostZone = .5;

/// (of a side) Largest distance between the ends of two sides that are bonded. In its first step
/// the bond closes that distance and strains the body by no more.
inline constexpr double kBondGap = 1e-9;
/// (of a side) Parallel sides no farther apart than this that do not match were probably meant to
/// be bonded: a message is given.
inline constexpr double kProbableBond = .01;

/// (of the shorter side of its own) To bond sides with different ends, a node slides along its side
/// onto a node of the other body up to this distance: its neighbour may do the same from the other
/// end, and a third of the side is left.
inline constexpr double kSlide = 1. / 3;
/// (of the shorter side) Corners of two outlines that are nearer are joined, and a new node has at
/// least this distance from the ends of the side that it divides. The critical time step falls in
/// this ratio; with .1 that of rubble masonry fell to .08 at worst.
inline constexpr double kJoinedCorners = .2;
/// (of a triangle's area) A node does not slide if it would leave less.
inline constexpr double kLeastSqueezed = .25;

/// (of the strength; count) The sweeps over cohesive tractions with common nodes end when no
/// traction changes by more, or after this number of sweeps. With ten times the first value the
/// dissipated energy of a plate's cracks is 0.2 % lower; with thirty times the second it is the
/// same to 10⁻⁵.
inline constexpr double kCohesionChange = 1e-6;
inline constexpr int kCohesionSweeps = 100;
/// (of the opening by the strength) Sweeps also end where no opening changes by more: then no node
/// moves, although tractions may still grow around a node that is split all round.
inline constexpr double kSameOpening = 1e-9;

/// (count; squared cosine; ratio) Acceleration of these sweeps. After each group of sweeps, except
/// the last ones, changes with the same direction as the changes before are summed up as a
/// geometric series with at most this ratio. Without it two stiff cracks side by side converge by a
/// thousandth a sweep, and seven times as many sweeps leave ten times the residual. With a ratio of
/// .999 changes that are no series were summed, too: 0.02 of the strength was left instead of
/// 0.001.
inline constexpr int kSweepsToSumUp = 3, kSweepsToSettle = 20;
inline constexpr double kSameChange = .99, kMostRatio = .99;

/// (of the opening and of the tractions' part in it; count) The Newton iteration for an opening in
/// mixed mode ends with a step below this; three or four steps are usual.
inline constexpr double kOpeningStep = 1e-14;
inline constexpr int kMostOpeningSteps = 30;

/// (one in so many) Reserve of node storage for the nodes that cracks add.
inline constexpr std::size_t kSpareNodes = 8;

/// (ratio) The size of elements that a message advises, of what suffices as a mean of their edges:
/// the edges of an irregular mesh are 1.03 to 1.07 of its `size`.
inline constexpr double kAdvisedSize = .9;

/// (ratio) Elements below this part of the strength are not those of a mean that reaches it:
/// rounding.
inline constexpr double kNearlyStrength = 1 - 1e-12;

}  // namespace yadefrag::tolerance
