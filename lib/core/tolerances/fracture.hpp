#pragma once
// Tolerances and thresholds of cracks, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (rad) A node whose triangles fill more of its surroundings is the tip of a notch or a crack: a
/// straight boundary fills π, and a deformed or rounded one some degrees more.
inline constexpr double kTipAngle = 3.46;

/// (elements) Along the cohesive zone. A notched beam bears 4 to 5 % too much with four
/// (notched_beam_test.cpp).
inline constexpr double kZoneElements = 4;

/// (of a side) Ends of sides that are bonded are no farther apart: what the bond pulls together in
/// its first step strains a body by no more.
inline constexpr double kBondGap = 1e-9;
/// (of a side) Sides that run along each other, no farther apart, but do not match: meant to.
inline constexpr double kBondMeant = .01;

/// (of the strength; count) Change of cohesive tractions at which the sweeps over those that share
/// nodes end, and how many there may be. With ten times the first a plate's cracks spend 0.2 %
/// less; with thirty times the second the same to 10⁻⁵.
inline constexpr double kCohesionChange = 1e-6;
inline constexpr int kCohesionSweeps = 100;

/// (count; squared cosine; ratio) After every so many sweeps but the last ones, changes that point
/// the same way as those before are summed up as the geometric series that they are, with at most
/// this ratio. Two cracks beside each other whose lines are stiff come nearer by a thousandth a
/// sweep else, and seven times as many sweeps leave ten times the residual. With a ratio of .999
/// sums of what is no series leave 0.02 of the strength instead of 0.001.
inline constexpr int kSweepsToSumUp = 3, kSweepsToSettle = 20;
inline constexpr double kSameChange = .99, kMostRatio = .99;

/// (of the opening and what the tractions take from it; count) A Newton step of an opening in mixed
/// mode that is as short as this was the last; three or four are usual.
inline constexpr double kOpeningStep = 1e-14;
inline constexpr int kMostOpeningSteps = 30;

/// (one in so many) Room for nodes that cracks add, beside those that are there.
inline constexpr std::size_t kSpareNodes = 8;

}  // namespace yadefrag::tolerance
