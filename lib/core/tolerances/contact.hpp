#pragma once
// Tolerances and thresholds of the detection of contact and of its rows, each with its unit and its
// reason.

namespace yadefrag::tolerance {

/// (of a piece's length) A slave no deeper than this inside a master at its first detection counts
/// as outside: bodies placed exactly on each other differ by rounding.
inline constexpr double kTouching = 1e-9;

/// (of the coordinates) The same for large coordinates: some roundings of a coordinate.
inline constexpr double kTouchRounding = 0x1p-50;

/// (rad) A corner that turns by more than this, 30°, is a slave in a single pass, too.
inline constexpr double kSharpCorner = .52;

/// (rad) A corner of a rigid boundary that turns by less lies on a straight line: files give facet
/// ends with six digits.
inline constexpr double kLineCorner = 1e-5;

/// (1/octave) Two surfaces are equally fine if their mean piece lengths, rounded to this part of an
/// octave, are equal. Deformation then does not swap slave and master repeatedly.
inline constexpr double kFinenessSteps = 8;

/// (ξ) A foot this far beyond a piece's end is still on the piece: rounding must not leave a gap
/// between two pieces at their joint.
inline constexpr double kFootRange = 1e-9;

/// (cosine) The cosine between a slave's normal and its master's must be below this. It excludes
/// the lateral faces at coincident corners, which are parallel except for rounding.
inline constexpr double kOpposed = -.1;

/// (sine) A sharp convex corner (turning by more than kSameFace) can touch a face if neither of its
/// sides is inclined into that face by more than 30°. With 6° contacts that tilt are dropped and
/// return as overlaps: in impacts contact then created ten times as much energy.
inline constexpr double kLeansIn = .5;

/// (of the search reach, which is twice the largest displacement) Applies to entry by flags, in
/// rubble. A slave that was outside its master and is inside by less than this, because of rounding
/// or of other contacts' corrections, still belongs to the master. With half or twice the value one
/// impact in twelve had pieces that overlap by more than half a segment. With ten times the value
/// corners that had passed a master's end were pushed back, and contact created ten times as much
/// energy.
inline constexpr double kRestoredDepth = .02;

/// (of the shortest segment) Applies to entry by the path. A slave no deeper than this behind a
/// piece at the start of a step counts as outside. In twelve impacts pieces overlap by up to 1.9e-4
/// of a segment with this value, 1.7e-4 with half and 4.2e-4 with twice of it. A quarter is less
/// than the errors of a step's corrections in rubble: one of the twelve impacts then loses a
/// contact.
inline constexpr double kEntryDepth = 4e-4;

/// (cosine) Two adjacent sides whose normals have a cosine below this are the two sides of one
/// line: its ends are corners with all normals in between.
inline constexpr double kFolded = -.999999;

/// (of a slave's depth behind a piece) At a concave joint a slave up to this far beyond the piece's
/// end is still inside the piece: the value is reached at the bottom of a notch of 11°.
inline constexpr double kPastConcave = 10;

/// (ξ) The force acts at the foot at xⁿ, which conserves the angular momentum, if that foot is no
/// farther than this beyond the piece's end. The shape functions are extended linearly.
inline constexpr double kFootBeyond = .25;

/// (cosine) Two adjacent pieces whose normals differ by less than 30° are one face for a slave that
/// slides from one to the other.
inline constexpr double kSameFace = .866;

/// (of the largest displacement in the step; of the shortest segment) Penetrations below these
/// sizes are not solved again. The first is the second-order remainder of the linearised contact
/// condition; it is an error of the same size in velocities. The second is rounding.
inline constexpr double kRemainder = 1e-5, kRemainingPenetration = 1e-10;

/// (count) Maximum number of detections in one step.
inline constexpr int kDetections = 10;

/// (of the last step's largest correction) Minimum reach of the first detection of a step. The
/// additional pairs cost less than a second detection.
inline constexpr double kReachSpare = 2.5;

/// (ratio) An overlap older than its contact is reduced in every step by this part of itself, and
/// by no more than this part of the largest displacement. If it were removed in one step, the
/// correction would become a velocity, and contact would create energy.
inline constexpr double kOverlapDecay = .02;

}  // namespace yadefrag::tolerance
