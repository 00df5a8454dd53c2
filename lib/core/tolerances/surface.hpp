#pragma once
// Tolerances and thresholds of boundary pieces and arcs, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (ξ) A Newton step of the foot on an arc that is as short as this was the last: ξ itself is known
/// to a few roundings only.
inline constexpr double kFootStep = 1e-15;

/// (count) Steps for the foot on an arc: halving alone gets from 1 to `kFootStep` in 50.
inline constexpr int kMostFootSteps = 100;

/// (count) Halvings of an arc that isolate its orthogonal feet; two that are nearer than 2⁻²⁰ are
/// one.
inline constexpr int kMostArcCuts = 20;

/// (relative to the chord) Rounding that the quick line test of a boundary piece forgives.
inline constexpr double kQuickLine = 1e-14;

}  // namespace yadefrag::tolerance
