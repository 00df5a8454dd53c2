#pragma once
// Tolerances and thresholds of the step: motion, halo, messages about energies, each with its unit
// and its reason.

#include <cstddef>
#include <cstdint>

namespace yadefrag::tolerance {

/// (of the shorter of the two segments) Largest relative displacement in one step of two bodies
/// about to touch. The reason is that of kWidestHalo: halos of adjacent segments must not overlap
/// (§4.1).
inline constexpr double kMostMotion = .5;

/// (of the shortest segment) Largest displacement of any surface node in one step: with a wider
/// halo every entry would be a candidate of every other. The value corresponds to more than ten
/// wave speeds.
inline constexpr double kFarthestMove = 10;

/// (of the bodies' largest energy; ratio) A message is given if contact or cracks have added more
/// than this energy. Energies are evaluated again when that amount has grown by the second value.
inline constexpr double kGivenEnergy = .01, kEvaluateAgain = 1.1;

/// (of the bodies' largest energy) A message is given if contact or friction alone has given more
/// energy than this to the other. Where friction reverses a motion it is less.
inline constexpr double kExchanged = .05;

/// (of the largest sum of m r v) A message is given if contact and cracks have created more angular
/// momentum. Cohesive tractions create none but for rounding.
inline constexpr double kGivenSpin = .001;

/// (of the longest step) The step that a message states: it must suffice although its digits are
/// rounded.
inline constexpr double kAdvised = .99;

/// (of the largest energy of the bodies that touch) A message is given if contact with YADE's
/// bodies has created more energy than this.
inline constexpr double kGivenBySpheres = .005;

/// (of the largest friction force) A contact with a larger tangential force slips: laws set it to
/// that largest value, except for rounding.
inline constexpr double kSlips = 1 - 1e-9;

/// (of the force) The law of a contact counts as linear if its normal force deviates by less from
/// stiffness times overlap.
inline constexpr double kSpring = 1e-9;

/// (s) YADE's O.dt until a script sets it. (of the critical step) A message is given at the first
/// step if O.dt is still that, and is below this.
inline constexpr double kDefaultStep = 1e-8, kShortStep = .5;

/// (steps) Interval between two evaluations of the kinetic energy: each costs half a per cent of a
/// step.
inline constexpr std::uint64_t kStepsToCheck = 8;

/// (steps) Interval between two sums over all energies: each takes as long as four steps.
inline constexpr std::uint64_t kStepsToSumUp = 1024;

/// (count; steps) A time step that has changed more often than the first value, and more than once
/// in the second, may excite vibrations.
inline constexpr std::uint64_t kFewChanges = 2, kStepsPerChange = 1000;

/// (relative) Rounding of a coordinate in a step. Measured energies of bodies at rest are a
/// twentieth of the estimate from it, at any distance from the origin and any time step.
inline constexpr double kRounding = 0x1p-53;

/// (of the shortest segment) A message is given if the penetration at the end of a step exceeds
/// this, or half a halo if that is less: beyond the halo, smooth surfaces have no contact.
inline constexpr double kDeep = .04;

/// (steps) Interval between two checks of the triangles themselves, with one pass: each takes 0.4
/// of a step of 36 blocks. An interval of 128 missed the overlaps above kDeep of two impacts in
/// four.
inline constexpr std::uint64_t kStepsToOverlap = 32;

/// (of the shortest segment) Limits of the halo's width. At most half, so that three adjacent halos
/// do not overlap (paper §4.1); at least a twentieth, below which no search is saved.
inline constexpr double kWidestHalo = .5, kNarrowestHalo = .05;

/// (steps) Number of steps for which a halo is wide enough at the present largest velocity.
inline constexpr double kHaloSteps = 40;

/// (ratio) Margin for acceleration in the prediction whether the next step leaves the halo.
inline constexpr double kHaloSpare = 1.1;

/// (ratio) Margin for acceleration until all velocities are checked again. While no node is faster
/// than that, a step needs no check of the nodes.
inline constexpr double kSpeedSpare = 1.25;

}  // namespace yadefrag::tolerance
