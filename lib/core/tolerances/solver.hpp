#pragma once
// Tolerances and thresholds of the forces of contact, each with its unit and its reason.

namespace yadefrag::tolerance {

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
/// changes a gap or a slip by more than this multiple, up to the second number. Where a light box
/// is between heavy blocks, 80 sweeps are too few at the impact, and contact would create energy
/// for some steps.
inline constexpr double kFarFromSolved = 10;
inline constexpr int kMostSweeps = 1000;

/// (count) Sweeps with the gaps of the positions that the former sweeps lead to. Without them a
/// disc that rattles in a ring has overlaps of 2e-4 instead of 2e-5 of a segment, and impacts give
/// four times as much energy.
inline constexpr int kLastSweeps = 2;

/// (ratio) A rigid body of which the neighbours give way by less than this part of itself transmits
/// nothing between them that matters.
inline constexpr double kLeastShare = 1e-5;

/// (ratio) The sweeps are as many as for a body with this share. A box of 1 g between blocks of 10 kg
/// would give a tenth of their energy otherwise.
inline constexpr double kUsedShare = 1e-3;

/// Named values of Contact::stop, and its limits: below the least one rounding decides, above the
/// greatest one contact is lost.
inline constexpr double kFineStop = 1e-4, kCoarseStop = 1e-2;
inline constexpr double kLeastStop = 1e-9, kMostStop = .1;

/// (of the product of both responses) Two rows with a smaller determinant are one: no pair of
/// forces is found for both.
inline constexpr double kSameRows = 1e-9;

}  // namespace yadefrag::tolerance
