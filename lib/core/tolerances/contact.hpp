#pragma once
// Tolerances and thresholds of the detection of contact and of its rows, each with its unit and its
// reason.

namespace yadefrag::tolerance {

/// The constants on which the outcome of contact depends besides rounding. Overlaps in the
/// following are the largest ones of any two triangles in 24 impacts, in parts of the shortest
/// segment, when the value was chosen; docs/measured.md has the present ones.
struct Contact {
  /// (of the shortest segment) A slave no deeper than this behind a piece at the start of a step
  /// counts as outside. It must exceed the errors of a step's corrections, otherwise a contact is
  /// lost.
  double outsideDepth = 4e-4;

  /// (sine) Two adjacent pieces whose normals differ by less than this angle, 20°, are one face for
  /// a slave that slides from one to the other. A convex corner with a larger angle is sharp: it is
  /// a slave in a single pass, too, and it can touch a face only if neither of its sides is
  /// inclined into that face by more than this angle. Overlaps are the same from 5° to 31°; at 43°
  /// one of four impacts loses a contact, at 60° fragments overlap by half a segment.
  double faceAngle = .34;

  /// (cosine) The cosine between a slave's normal and its master's must be below this. It excludes
  /// the lateral faces at coincident corners, which are parallel except for rounding.
  double opposed = -.1;

  /// (of a slave's depth behind a piece) At a concave junction a slave up to this far beyond the
  /// piece's end is still inside the piece: the value is reached at the bottom of a notch of 11°.
  double pastConcave = 10;

  /// (ratio) An overlap older than its contact is reduced in every step by this part of itself, and
  /// by no more than this part of the largest displacement. An overlap that is removed in one step
  /// becomes a velocity. With .02 overlaps of 4e-4 accumulate in rubble, and slaves are lost.
  double overlapDecay = .2;

  /// (count) Contact is solved by at most this number of sweeps at each of at most kDetections
  /// detections, unless they are far from a solution (kFarFromSolved); the next step goes on from
  /// their forces. What remains must be less than outsideDepth: with 20 sweeps overlaps in impacts
  /// are 2e-4 to 9e-3, with 40 8e-5, with 160 overlaps are .8 times those with 80, for 1.4 times
  /// the time.
  int rowSweeps = 80;
};

/// (of a piece's length) A slave no deeper than this inside a master counts as outside: bodies
/// placed exactly on each other differ by rounding.
inline constexpr double kTouching = 1e-9;

/// (of the shortest segment) A new contact of pieces that cohesion holds together begins only if it
/// is deeper than this. It must be well below Contact::outsideDepth, otherwise contacts are lost.
/// With 1e-5 and 4e-5 a ring of two rows takes 2.6 and 1.5 times the time; overlaps are the same.
inline constexpr double kHeldDepth = 1e-4;

/// (of the coordinates) The same for large coordinates: some roundings of a coordinate.
inline constexpr double kTouchRounding = 0x1p-50;

/// (sine) A corner of a rigid boundary that turns by less lies on a straight line: files give facet
/// ends with six digits.
inline constexpr double kLineCorner = 1e-5;

/// (1/octave) Two surfaces are equally fine if their mean piece lengths, rounded to this part of an
/// octave, are equal. Deformation then does not swap slave and master repeatedly.
inline constexpr double kFinenessSteps = 8;

/// (ξ) A foot this far beyond a piece's end is still on the piece: rounding must not leave a gap
/// between two adjacent pieces.
inline constexpr double kFootRange = 1e-9;

/// (cosine) Two adjacent sides whose normals have a cosine below this are the two sides of one
/// line: its ends are corners with all normals in between.
inline constexpr double kFolded = -.999999;

/// (ξ) The force acts at the foot at xⁿ, which conserves the angular momentum, if that foot is no
/// farther than this beyond the piece's end. The shape functions are extended linearly. Any larger
/// value gives the same bits in 24 impacts.
inline constexpr double kFootBeyond = .25;

/// (ξ) A foot this near to a node is at the node. In a wall of blocks that touch exactly, forces at
/// one end of a block's side then do not depend on those at its other end.
inline constexpr double kFootAtNode = 1e-7;

/// (ξ) The same for a slave without friction that has passed the end of its master within the step,
/// at a corner, if its foot at xⁿ was no farther than this inside the end: slaves that slide in
/// cracks are up to .0015 inside.
inline constexpr double kFootWithin = .002;

/// Penetrations below the largest of three sizes are not solved again.
/// (of the largest displacement in the step; of the shortest segment) The first two matter to slow
/// bodies: with five times as much, forces at the foot of fifty squares have errors of 3e-4.
inline constexpr double kRemainder = 2e-6, kRemainingPenetration = 2e-11;

/// (of the largest displacement squared, over the shortest segment; of the shortest segment) The
/// third is a part of the second-order remainder of the linearised contact condition, up to the
/// second value. With .1 a patch has a force error of 7e-5, with .05 of 1e-5. With a sixth of
/// kChange besides, an impact takes 1.3 times the time.
inline constexpr double kSecondOrder = .05, kMostRemainder = 1e-5;

/// (of the shortest segment) Contacts that the corrections of a step cause begin in the next step,
/// without another search, if they cannot be deeper than this. Walls at rest then need one search
/// per step. With 1e-4 impacts take the same time.
inline constexpr double kLateContact = 1e-5;

/// (of the reach plus the depth of the deepest contact) A slave past a piece's end by more than
/// this is not near the piece: within the step both move by at most the reach together.
inline constexpr double kBeside = 6;

/// (of a piece's length) An overlap that a crack causes by straightening an arc is tolerated up to
/// this depth; a deeper slave is in another part of the body.
inline constexpr double kStraightened = .25;

/// (count) Maximum number of detections in one step. With 10 overlaps in impacts are the same, for
/// 1.3 times the time.
inline constexpr int kDetections = 4;

/// (of the last step's largest correction) Minimum reach of the first detection of a step. The
/// additional pairs cost less than a second detection.
inline constexpr double kReachSpare = 2.5;

}  // namespace yadefrag::tolerance
