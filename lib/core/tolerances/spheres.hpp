#pragma once
// Thresholds of the contact of YADE's spheres and rigid bodies with boundaries, each with its unit
// and its reason.

namespace yadefrag::tolerance {

/// (relative) Overlaps with a piece before and after a crack that differ by less are the same: the
/// positions before the step are computed back from those after it, with rounding.
inline constexpr double kSameOverlap = 1e-9;

/// (count) Junctions along a boundary up to which a piece continues the contact of another one. A
/// sphere moves from piece to piece in single steps; fans of new faces have some pieces between.
inline constexpr int kJunctionsToContact = 8;

/// ((ω Δt)², ω of the contact's spring between the masses that it moves) Up to this the step
/// resolves a contact by 28 steps in a period, and a shorter one does not create less energy. In
/// tests 0.4 creates 28 % of a sphere's energy, 0.004 none.
inline constexpr double kStiffContact = .05;

/// (of a sphere's radius) Largest overlap with a body that is added, or of a sphere that is added:
/// a hundredth holds 10⁻⁴ of the energy of half an overlap, and places are computed with few
/// digits.
inline constexpr double kPlacedOverlap = .01;

/// (of a sphere's radius) A message is given if a sphere overlaps a body by more than this: at 1
/// its centre is inside, and beyond it may leave on the other side.
inline constexpr double kDeepSphere = .5;

/// (of a sphere's radius) A sphere that approaches by more than this in a step may pass through,
/// however stiff it is.
inline constexpr double kFastSphere = .1;

/// (rad) Change of a corner of a boundary up to which a polygon counts as not bent.
inline constexpr double kBent = .01;

/// (of a side) A message is given if the arc of a smooth boundary enters a wall deeper than this
/// between two points of contact. A disc of 48 sides then stands on a slope of 0.04.
inline constexpr double kArcDepth = .01;

/// (relative) Moments of inertia about z that differ by less are the same: YADE computes those of
/// clumps with overlapping members by a grid, and scripts set them with a few digits.
inline constexpr double kSameMoment = .01;

}  // namespace yadefrag::tolerance
