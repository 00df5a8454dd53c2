#pragma once
// Tolerances and thresholds of boundary pieces and arcs, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (ξ) The Newton iteration for the foot on an arc ends with a step below this: ξ itself is
/// accurate to a few roundings only.
inline constexpr double kFootStep = 1e-15;

/// (count) Maximum number of iterations for the foot on an arc: bisection alone reaches `kFootStep`
/// from 1 in 50.
inline constexpr int kMostFootSteps = 100;

/// (count) Bisections of an arc that separate its orthogonal feet; two feet nearer than 2⁻²⁰ are
/// one.
inline constexpr int kMostArcCuts = 20;

}  // namespace yadefrag::tolerance
