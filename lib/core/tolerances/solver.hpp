#pragma once
// Tolerances and thresholds of the forces of contact, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (count) Sweeps of contact to one of the cohesive tractions at the same nodes. A block that
/// breaks on a wall takes 1.9 times the time with 1, 1.45 times with 4, 8 or more, of that without
/// common sweeps; `contact` falls by at most 2e-5 of the energy with 4, 1.6e-4 with 16.
inline constexpr int kSweepsToCouple = 4;

/// (of the penetration that needs another solution) Sweeps end as soon as none changes a gap or a
/// slip by more than this.
inline constexpr double kChange = .3;

/// (of that change; count) Beyond Contact::rowSweeps sweeps go on while one changes a gap or a slip
/// by more than this multiple, up to the second number. Where a light box is between heavy blocks,
/// 80 sweeps are too few at the impact, and contact would create energy for some steps.
inline constexpr double kFarFromSolved = 100;
inline constexpr int kMostSweeps = 1000;

/// (count) Sweeps of all rows together, before they are divided into groups. Most solutions of
/// elastic bodies need fewer, and the division takes as long as four sweeps.
inline constexpr int kSweepsToDivide = 10;

/// (count; count; ratio; count) Sweeps of a group before its first conjugate gradients, sweeps
/// between two of them, the ratio by which there are more sweeps after a bound has ended one, and
/// iterations of one. In walls of blocks the next bound is always near: with the first one after
/// 10, 20, 40 sweeps walls take 1.3, 1.2, 1.0 times the time, without gradients .95 times. But
/// without them two sides that touch, both slaves in two passes, need thousands of sweeps.
inline constexpr int kSweepsToDescend = 20, kSweepsAfterDescent = 2, kMoreSweeps = 4,
                     kDescents = 200;

/// (of the curvature of the rows alone) Conjugate gradients end in a direction in which the rows
/// contradict each other more than by this: the forces that close a gap in it are larger by the
/// inverse of this, and move the pieces sideways. With a compliance of 1e-5 of each row instead,
/// forces became 4,700 times as large in one step, and a block that broke on a box gained six times
/// its energy. With 1e-4 a patch has a force error of 3e-5 (1.4e-5), with 1e-3 blocks that slide
/// down a slope in two passes have an error of .018 of their acceleration.
inline constexpr double kContrary = 1e-5;

}  // namespace yadefrag::tolerance
