#pragma once
// Thresholds of the contact of YADE's spheres with boundaries, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (relative) Overlaps with a piece before and after a crack that differ by less are the same: the
/// positions before the step are computed back from those after it, with rounding.
inline constexpr double kSameOverlap = 1e-9;

/// (count) Joints along a boundary up to which a piece continues the contact of another one. A
/// sphere moves from piece to piece in single steps; fans of new faces have some pieces between.
inline constexpr int kJointsToContact = 8;

}  // namespace yadefrag::tolerance
