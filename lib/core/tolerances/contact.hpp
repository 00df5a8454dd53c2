#pragma once
// Tolerances and thresholds of the detection of contact and of its rows, each with its unit and its
// reason.

namespace yadefrag::tolerance {

/// (of a piece's length) Slaves this little inside a master when they first come near count as
/// outside: bodies laid exactly on one another differ by rounding.
inline constexpr double kTouching = 1e-9;

/// (of the coordinates) The same where coordinates are large: what a few of their roundings are.
inline constexpr double kTouchRounding = 0x1p-50;

/// (rad) A corner that turns by more is a slave in a single pass too: 30°.
inline constexpr double kSharpCorner = .52;

/// (rad) A corner of a rigid boundary that turns by less is on a line: facets whose ends are given
/// with six digits.
inline constexpr double kLineCorner = 1e-5;

/// (1/octave) Surfaces whose mean piece lengths are equal when rounded to this part of an octave
/// count as equally fine, so that deformation does not make slaves and masters take turns.
inline constexpr double kFinenessSteps = 8;

/// (ξ) A foot this far beyond a piece's end is still on it: at a joint of two pieces, rounding must
/// not leave a slave between them.
inline constexpr double kFootRange = 1e-9;

/// (cosine) A slave's normal and its master's must be opposed by more than this: at coincident
/// corners the lateral faces, parallel to rounding, take no part.
inline constexpr double kOpposed = -.1;

/// (sine) A sharp convex corner, one that turns by more than kSameFace, touches a face as long as
/// neither of its sides leans through that face by more than 30°. At 6° contacts that tilt are
/// dropped and come back as overlaps: in impacts contact then created ten times as much energy.
inline constexpr double kLeansIn = .5;

/// (of the reach, which is twice the largest displacement) By flags, in rubble, a slave that was
/// outside and is left this little inside by rounding or by the others' correction is still the
/// master's. With half or twice of it one impact in twelve had pieces that overlap by more than
/// half a segment; with ten times as much, corners that had gone round a master's end were pushed
/// back, and contact created ten times as much energy.
inline constexpr double kLeftInside = .02;

/// (of the shortest segment) By the path, a slave behind a piece by no more than this at the start
/// of a step counts as before it. In twelve impacts pieces overlap by up to 1.9e-4 of a segment
/// with this, 1.7e-4 with half and 4.2e-4 with twice of it; with a quarter, less than what a step's
/// corrections leave in rubble, one of the twelve loses a contact.
inline constexpr double kEntryDepth = 4e-4;

/// (cosine) Two sides whose normals are opposed by more than this are those of a line that has
/// both: its ends are corners with all normals in between.
inline constexpr double kFolded = -.999999;

/// (of a slave's depth behind a piece) Farthest past an end of the piece, at a concave joint, that
/// it is inside the piece all the same: at the bottom of a notch of 11° it is as far.
inline constexpr double kPastConcave = 10;

/// (ξ) Farthest beyond a piece's end that the foot at xⁿ may be for the force to act at that foot,
/// which keeps the angular momentum; the shape functions go on linearly.
inline constexpr double kFootBeyond = .25;

/// (cosine) Two neighbouring pieces whose normals differ by less than 30° are one face for a slave
/// that slides from one to the other.
inline constexpr double kSameFace = .866;

/// (of the largest displacement in the step; of the shortest segment) Penetration that is left by
/// the second-order remainder of the linearised condition and not worth another solve: an error of
/// so much in velocities, and what rounding leaves.
inline constexpr double kRemainder = 1e-5, kPenetrationLeft = 1e-10;

/// (count) Most detections in one step.
inline constexpr int kDetections = 10;

/// (of the last step's largest correction) How far the first scan of a step looks at least: the few
/// pairs more take less time than a second scan.
inline constexpr double kReachSpare = 2.5;

/// (ratio) An overlap older than its contact is let out by this part in every step, and by no more
/// than this part of the largest displacement. Pushed out in one step it would become a velocity,
/// and contact would create energy.
inline constexpr double kOverlapDecay = .02;

}  // namespace yadefrag::tolerance
