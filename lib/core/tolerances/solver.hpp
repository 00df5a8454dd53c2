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
