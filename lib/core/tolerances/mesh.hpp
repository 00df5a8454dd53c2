#pragma once
// Tolerances and thresholds of meshes, joints and their checks, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (count) Triangles above this many are not counted by 32-bit numbers with a sign to spare.
inline constexpr double kMostTriangles = 2147483648.;

/// (bytes) Of memory that a triangle takes at the least, all told, in its first step: measured in
/// squares of 10⁵ to 6·10⁵.
inline constexpr double kTriangleBytes = 400;

/// (count) Triangles whose masses and stiffnesses are summed in a node without leaving the range of
/// numbers.
inline constexpr double kMostSummed = 1000;

/// (of the largest coordinate) Smallest size of triangles: below, twelve bits of their sides would
/// be left of the coordinates' 52.
inline constexpr double kLeastSize = 0x1p-40;

/// (of the largest coordinate) Least way in a step that a body may be sent at: 16 roundings.
inline constexpr double kSeenMotion = 0x1p-49;

/// (rad) A triangle with a smaller angle has no area to speak of: of its 52 bits, about half are
/// rounding.
inline constexpr double kLeastAngle = 1e-8;

/// (tangent) Of the smallest angle, 35°, from which on nodes are moved to even the triangles out,
/// though a smallest angle may shrink down to this.
inline constexpr double kGoodTan = .7;

/// (of the mean side around a node) Least height of the triangles at a scattered node from which on
/// it is not moved for their sake. At .5 steps are 5 % shorter; at .6 angles fall below 30°.
inline constexpr double kGoodHeight = .55;

/// (ratio) A critical step that is shorter than an even lattice's by this factor is worth a
/// warning; irregular meshes have up to 1.5.
inline constexpr double kCostlyStep = 3;

/// (of the longest line; of the line) Shortest line of edges that is compared with its length, and
/// the longest path along it that is looked for; in a lattice at most 1.16.
inline constexpr double kShortestLine = .6, kLongestPath = 1.3;

/// (m/m) Growth of the wanted edge length with the distance from a boundary of shorter edges.
inline constexpr double kEdgeGrowth = .25;

/// (count) Steps of the integral along an edge in each of its parts.
inline constexpr double kStepsPerPart = 8;

/// (of the wanted edge length) A new node keeps this distance from all others, and this one from
/// the boundary's edges; a regular layout has 1 and 0.87.
inline constexpr double kNodeClearance = .75, kBoundaryClearance = .6;

/// (count) Places in the box of an outline that are tried for a grain: of an outline that fills a
/// thousandth of its box, so many find ten on average.
inline constexpr int kPlaceTries = 10000;

/// (count) Places that are tried for a new node around another one; with 20, one triangle in 10⁴
/// has a corner below 35°.
inline constexpr int kNodeTries = 30;

/// (of the squared tolerance) By how much equal costs of vertices that an outline could do without
/// get different values, so that their order is the same in every run.
inline constexpr double kEqualCosts = 1e-6;

/// (of the size there) A joint that ends this near the outline or another joint ends on it: the
/// places where lines meet are known to rounding only.
inline constexpr double kJointMeets = 1e-6;

/// (of an edge's length) A point this near an edge of the boundary may be one that divides it.
inline constexpr double kOnEdge = 1e-9;

/// (of the product of the four sides) An edge is flipped when the angles across it exceed 180° by
/// more than rounding, so that two equal choices do not take turns.
inline constexpr double kFlip = 1e-9;

/// (strain) A body that is stressed from the start may be stretched by this much: beyond, the law
/// is none of a solid, and compression has no unique answer near 1.
inline constexpr double kMostStretch = .5;

}  // namespace yadefrag::tolerance
