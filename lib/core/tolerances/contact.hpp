#pragma once
// Tolerances and thresholds of the detection of contact and of its rows, each with its unit and its
// reason.

namespace yadefrag::tolerance {

/// The constants of contact that a scene can have of its own. Overlaps in the following are the
/// largest ones of any two triangles in impacts, in parts of the shortest segment.
struct Contact {
  /// (sine) Up to this angle, 20°, a corner's sides may lean into a side that holds it, and a
  /// corner that turns inwards by less can touch a side. A convex corner with a larger angle is a
  /// slave in a single pass, too.
  double faceAngle = .34;

  /// (of the shortest segment, per sine) A side counts as nearer to being violated by this, the
  /// more the other corner's sides lean into it. It singles out the common side of two corners that
  /// coincide, as at a crack. With faceAngle alone overlaps are 1e-2.
  double leaning = .1;

  /// (of the largest displacement in the step) A pair has a row if its gap, beyond an overlap at
  /// xⁿ, is at most this at the end of the step without contact: forces of other rows may still
  /// close it. With 0 overlaps are 2e-2, with .2 up to .014 at 200 m/s.
  double slack = .5;

  /// (ratio) An overlap is reduced in every step by this part of itself, and by no more than this
  /// part of the largest displacement: what is removed in one step becomes a velocity. With .1
  /// overlaps are the same.
  double overlapDecay = .2;

  /// (of the largest displacement in the step) Sweeps end as soon as none changes a gap or a slip
  /// by more. With 1e-2 overlaps have a median of 1.4e-4 and contact gives 1.5e-4 of the energy,
  /// with 3e-3 5e-5 and 3e-6, with 1e-3 3e-5 and 2e-6.
  double stop = 3e-3;

  /// (count) Maximum number of sweeps in a step, unless the forces are far from a solution
  /// (kFarFromSolved). With 16 overlaps are 3e-4 and contact gives 1e-5 of the energy, with 32 1e-4
  /// and 2e-6.
  int rowSweeps = 64;
};

// --- Which pairs have which row (contact/near_rows.hpp).

/// (of the shortest segment; of the largest displacement) A slave nearer than the larger one to the
/// end of a side belongs to the corner there. With .02 and .1 of the segment overlaps are the same.
inline constexpr double kZone = .05, kZoneMoves = 2.5;

/// (of the shortest segment) Maximum of the zone. A pair may approach by half a segment in a step.
inline constexpr double kWidestZone = .4;

/// (of the zone; of its square) Pairs farther from each other than the first cannot touch in the
/// step. Corners are met within a circle that is smaller by rounding.
inline constexpr double kWide = 1.5, kInCircle = 1 - 1e-9;

/// (ratio) Slaves are not looked at while all nodes have moved by less than the first of the gap
/// that keeps a pair open, with the turn of its side, and of at most the second, of the shortest
/// segment. Then no sine has changed by kStillConvex.
inline constexpr double kOpenShare = .2, kMostOpen = .05, kStillConvex = .1;

/// (of slack and displacement) A pair whose gap is larger has no row: both move towards each other,
/// and the gap at x* must be above two slacks.
inline constexpr double kClosing = 2.1;

/// (of the wide distance) Farther pieces are not near, arcs with their bulge neither.
inline constexpr double kFar = 1.5;

/// (of its distance from a side's end) A corner deeper than this behind the middle of a side came
/// past the end.
inline constexpr double kThrough = .5;

/// (of the shortest segment) A side with a gap above the negative of this is open.
inline constexpr double kOpen = 1e-4;

/// (ratio) Of two sides that both separate, the one that the other corner is over comes first: the
/// distance beside the side counts by this part.
inline constexpr double kPerBeside = .05;

/// (cosine) Two sides with a smaller one are antiparallel, and if they overlap by more than
/// kPartner (of the shortest segment) two rows are needed. Without the second one overlaps
/// are 1.6e-2 at 200 m/s.
inline constexpr double kAntiparallel = -.94, kPartner = .02;

/// (sine) A corner that turns by less, to the void, is a notch.
inline constexpr double kNotch = -1e-6;

/// (cosine) Two sides of a notch with a larger one hold a tip as one side, that which is nearer at
/// x*. With .995 instead the tip ends behind the other side, with overlaps of 2e-3.
inline constexpr double kOneSide = .9995;

/// (cosine) A tip in a notch faces a side of it if the cosine between the normals of one of its own
/// sides and of that side is smaller.
inline constexpr double kFacing = -.1;

/// (ratio) A corner is on the other side of a side, as that of a line, if the sum of the unit
/// normals of its own sides points along that side's normal by more than this. At the tip of a
/// splinter the sum is nearly 0.
inline constexpr double kAway = .5;

/// (ξ) A foot this far beyond a piece's end is still on an arc: rounding must not leave a gap
/// between two adjacent pieces.
inline constexpr double kFootRange = 1e-9;

/// (ξ) The force acts at the foot at xⁿ, which conserves the angular momentum, if that foot is no
/// farther than this beyond the piece's end. The shape functions are extended linearly.
inline constexpr double kFootBeyond = .25;

/// (ξ) A foot this near to a node is at the node. In a wall of blocks that touch exactly, forces at
/// one end of a block's side then do not depend on those at its other end.
inline constexpr double kFootAtNode = 1e-7;

// --- What a row holds.

/// (of the shortest segment; ratio) An overlap below the first is reduced by the second in a step.
/// Blocks creep on a slope otherwise, and two faces that rest on each other never come to rest:
/// with .1 a patch has a stress error of .0075, with .03 of 6e-4. With .03 an undamped stack of 50
/// squares, two passes, begins to tremble after 30,000 steps: each reduction is a small blow.
inline constexpr double kShallow = 1e-5, kShallowDecay = .003;

/// (ratio) An overlap is reduced by no more than the largest displacement, or than this part of
/// what the row's force of the last step moves the row by: at rest nothing else moves, and what the
/// sweeps had left would remain as an uneven pressure.
inline constexpr double kOwnPart = .01;

/// (of the shortest segment) A new contact of pieces that cohesion holds together begins only if it
/// is deeper than this. With 1e-5 a ring of two rows takes 2.6 times the time.
inline constexpr double kHeldDepth = 5e-5;

// --- Which points are slaves, and which bodies touch.

/// (of a piece's length) A slave no deeper than this inside a master counts as outside: bodies
/// placed exactly on each other differ by rounding.
inline constexpr double kTouching = 1e-9;

/// (of the coordinates) The same for large coordinates: some roundings of a coordinate.
inline constexpr double kTouchRounding = 0x1p-50;

/// (cosine) Two adjacent sides whose normals have a cosine below this are the two sides of one
/// line.
inline constexpr double kFolded = -.999999;

/// (sine) A corner of a rigid boundary that turns by less lies on a straight line: files give facet
/// ends with six digits.
inline constexpr double kLineCorner = 1e-5;

/// (1/octave) Two surfaces are equally fine if their mean piece lengths, rounded to this part of an
/// octave, are equal. Deformation then does not swap slave and master repeatedly.
inline constexpr double kFinenessSteps = 8;

// --- Tolerances and thresholds of the forces of contact, each with its unit and its reason.

/// (count) Sweeps of contact to one of the cohesive tractions at the same nodes. A block that
/// breaks on a wall takes 1.9 times the time with 1, 1.45 times with 4, 8 or more, of that without
/// common sweeps; `contact` falls by at most 2e-5 of the energy with 4, 1.6e-4 with 16.
inline constexpr int kSweepsToCouple = 4;

/// (of the largest change in the first sweep) Sweeps end at this change if it is less than
/// Contact::stop: where little changes from step to step, forces of redundant rows must still
/// follow. Without it a patch has a stress error of .0027 and a force error of 4e-5, with it of
/// 6e-4 and 9e-7; impacts and walls take the same time.
inline constexpr double kOfFirst = .1;

/// (of the shortest segment) Sweeps end at this change, even if nothing moves: rounding.
inline constexpr double kLeastChange = 1e-13;

/// (of the change at which sweeps end) A row is visited again if its nodes have moved by more.
inline constexpr double kMakesDue = .3;

/// (of the change at which sweeps end; count) Beyond Contact::rowSweeps sweeps go on while one
/// changes a gap or a slip by more than this multiple, up to the second number.
inline constexpr double kFarFromSolved = 10;
inline constexpr int kMostSweeps = 1000;

/// (count) Sweeps with the gaps of the positions that the former sweeps lead to. Without them a
/// disc that rattles in a ring has overlaps of 2e-4 instead of 2e-5 of a segment, and impacts give
/// four times as much energy.
inline constexpr int kLastSweeps = 2;

/// (of a row's response) Neighbours of a rigid body that give way by less, held ones among them,
/// are taken as this compliant in one joint solution of its rows; the sweeps find the rest.
inline constexpr double kLeastShare = 1e-12;

/// (count; of the sum of its terms; ratio) Newton's method for the motion of a rigid body ends at
/// this residual, which is rounding: mostly after two to four iterations.
inline constexpr int kMostNewton = 50;
inline constexpr double kNewtonResidual = 1e-13, kShortestSearch = 1e-6;

/// (count; of the largest bound) Solutions for the bounds of friction by the normal forces of the
/// solution before, until they change by less.
inline constexpr int kFrictionPasses = 10;
inline constexpr double kFrictionChange = 1e-6;

/// Named values of Contact::stop, and its limits: below the least one rounding decides, above the
/// greatest one contact is lost.
inline constexpr double kFineStop = 1e-4, kCoarseStop = 1e-2;
inline constexpr double kLeastStop = 1e-9, kMostStop = .1;

/// (of the product of both responses) Two rows with a smaller determinant are one: no pair of
/// forces is found for both.
inline constexpr double kSameRows = 1e-9;

}  // namespace yadefrag::tolerance
