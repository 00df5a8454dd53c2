#pragma once
// Tolerances and thresholds of meshes, joints and their checks, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (count) Maximum number of triangles, 2³¹: triangle numbers have 32 bits, of which one is in
/// reserve.
inline constexpr double kMostTriangles = 2147483648.;

/// (bytes) Minimum memory per triangle in the first step, all arrays included: measured in squares
/// of 10⁵ to 6·10⁵ triangles.
inline constexpr double kTriangleBytes = 400;

/// (count) Number of triangles at a node whose masses and stiffnesses may be summed without
/// overflow.
inline constexpr double kMostSummed = 1000;

/// (of the largest coordinate) Smallest size of triangles: below it, sides of triangles would keep
/// less than twelve of the coordinates' 52 bits.
inline constexpr double kLeastSize = 0x1p-40;

/// (of the largest coordinate) Smallest displacement in a step that a given velocity must cause: 16
/// roundings of a coordinate.
inline constexpr double kLeastMotion = 0x1p-49;

/// (rad) Smallest angle of a triangle. Below it, about half of the 52 bits of the triangle's area
/// are rounding.
inline constexpr double kLeastAngle = 1e-8;

/// (tangent) 35°. A node is moved towards even triangles only if the smallest angle around it does
/// not become smaller or stays above this.
inline constexpr double kGoodTan = .7;

/// (of the mean side around a node) A scattered node is moved to increase the heights of its
/// triangles until they reach this value. With .5 time steps are 5 % shorter; with .6 angles fall
/// below 30°.
inline constexpr double kGoodHeight = .55;

/// (ratio) A critical time step shorter than that of an even lattice by this factor gives a
/// message; irregular meshes have up to 1.5.
inline constexpr double kCostlyStep = 3;

/// (m/m) Growth of the desired edge length with the distance from a boundary with shorter edges.
inline constexpr double kEdgeGrowth = .25;

/// (of a part) An edge whose length in sizes is a half up to this has the larger number of parts.
inline constexpr double kHalf = 1e-9;

/// (of the size, or of the shortest edge of the boundary if that is less) The places of nodes on
/// the boundary are rounded to this before a mesh is made inside: rounding of coordinates, which
/// differs between metres and millimetres, then does not decide between equally good triangles.
inline constexpr double kMeshPlaces = 0x1p-30;

/// (count) Integration steps in each part of an edge.
inline constexpr double kStepsPerPart = 8;

/// (of the desired edge length) Minimum distance of a new node from other nodes, and from the edges
/// of the boundary. A regular lattice has 1 and 0.87.
inline constexpr double kNodeClearance = .75, kBoundaryClearance = .6;

/// (count) Points that are tried for a new node around another one. With 20, one triangle in 10⁴
/// has a corner below 35°.
inline constexpr int kNodeTries = 30;

/// (of the size there) Ends and intersections of joints that are nearer than this are joined in any
/// case: intersections are known only up to rounding.
inline constexpr double kJointMeets = 1e-6;

/// (count) Rounds in which joints bend to near points, until none is left. Four are usual.
inline constexpr int kJointRounds = 50;

/// (of the largest coordinate) Vertices of outlines nearer than this are equal up to rounding: four
/// roundings of a coordinate.
inline constexpr double kSnapRounding = 0x1p-50;

/// (of an edge's length) A point this near to an edge of the boundary may lie on it and divide it.
inline constexpr double kOnEdge = 1e-9;

/// (of the product of the four sides) An edge is flipped if the sum of its opposite angles exceeds
/// 180° by more than this, which is rounding. Two equal alternatives therefore do not alternate.
inline constexpr double kFlip = 1e-9;

/// (strain) Largest initial strain of a body. Beyond it the material law does not describe a solid,
/// and compression has no unique solution near 1.
inline constexpr double kMostStretch = .5;

/// (count) Most iterations for an initial stress with that across the plane: each multiplies the
/// error by the strain, at most a half.
inline constexpr int kStretches = 60;

// --- Tolerances and thresholds of boundary pieces and arcs, each with its unit and its reason.

/// (ξ) The Newton iteration for the foot on an arc ends with a step below this: ξ itself is
/// accurate to a few roundings only.
inline constexpr double kFootStep = 1e-15;

/// (count) Maximum number of iterations for the foot on an arc: bisection alone reaches `kFootStep`
/// from 1 in 50.
inline constexpr int kMostFootSteps = 100;

/// (count) Bisections of an arc that separate its orthogonal feet; two feet nearer than 2⁻²⁰ are
/// one.
inline constexpr int kMostArcCuts = 20;

}  // namespace yadefrag::tolerance
