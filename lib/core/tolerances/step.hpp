#pragma once
// Tolerances and thresholds of the step: motion, halo, watch over energies, each with its unit and
// its reason.

#include <cstddef>
#include <cstdint>

namespace yadefrag::tolerance {

/// (of the shorter of the two segments) Farthest that bodies about to touch may move against each
/// other in one step: halos of adjacent segments must not overlap, for the same reason (§4.1).
inline constexpr double kMostMotion = .5;

/// (of the shortest segment) Farthest that any surface node may move in one step: with a halo for
/// more, everything would be a candidate of everything. Ten wave speeds and more.
inline constexpr double kFarthestMove = 10;

/// (of the bodies' largest energy; ratio) What contact or cracks may have given before a sentence
/// says so, and growth of it for which energies are looked at again.
inline constexpr double kGivenEnergy = .01, kLookAgain = 1.1;

/// (steps) From one look at the kinetic energy to the next: half a per cent of a step's work each.
inline constexpr std::uint64_t kStepsToLook = 8;

/// (steps) From one sum over all energies to the next: it takes as long as four steps.
inline constexpr std::uint64_t kStepsToSumUp = 1024;

/// (count; steps) A step that has changed more often than this, and more than once in so many
/// steps, may feed vibrations.
inline constexpr std::uint64_t kFewChanges = 2, kStepsPerChange = 1000;

/// (relative) Rounding of a coordinate in a step. Energies of bodies at rest are a twentieth of
/// what it gives, at any distance from the origin and any step.
inline constexpr double kRounding = 0x1p-53;

/// (of the shortest segment) Penetration left in a step above which a sentence says so; half a halo
/// if that is less, for beyond the halo smooth surfaces hold nothing.
inline constexpr double kDeep = .1;

/// (of the shortest segment) The halo's width: at most half, so that three adjacent halos do not
/// overlap (paper §4.1); at least a twentieth, below which nothing is saved.
inline constexpr double kWidestHalo = .5, kNarrowestHalo = .05;

/// (steps) For how many a halo is made wide enough at the present largest velocity.
inline constexpr double kHaloSteps = 40;

/// (ratio) Spare for acceleration when it is foreseen whether the next step leaves the halo.
inline constexpr double kHaloSpare = 1.1;

/// (of the reach) A body is isolated if all others are farther away than `kApart` times the reach.
/// The margin keeps the choice the same from one check to the next. Gaps up to `kApartLook` times
/// the reach are computed; a body covers such a gap in some hundred steps.
inline constexpr double kApart = 2, kApartLook = 8;

/// (of the largest move in a step) Reach of bodies that are apart, if that is more than the halo:
/// even two that fly towards each other are seen well before they could meet.
inline constexpr double kApartMoves = 8;

/// (ratio) Margin for acceleration until all velocities are checked again. As long as no node is
/// faster than this, a step needs no check of the nodes.
inline constexpr double kSpeedSpare = 1.25;

/// (count) Boxes that are sooner compared with each other than sorted.
inline constexpr std::size_t kFewBoxes = 12;

}  // namespace yadefrag::tolerance
