#pragma once
// What still holds an edge together that has begun to open.
//
//   The irreversible linear law of Camacho and Ortiz 1996 (Int. J. Solids Struct. 33, 2899),
//   extrinsic: there is no opening below the strength σc. T over the effective opening δ:
//
//     σc ┤╲              loading: the envelope T = σc(1 − δ/δc), δc = 2Gc/σc, so that its area is
//     Gc
//        │ ╲
//        │  ╳            below the largest opening so far: towards the origin and back
//        │╱   ╲
//        └──┴──┴─ δ      from δc on: nothing, for good. Gc = 0: δc = 0, opens at once
//          δmax δc

namespace yadefrag {

/// (Pa) Most that an edge of strength σc (Pa) holds when opened further than ever, to δ (m).
[[nodiscard]] double envelope(double strength, double criticalOpening, double opening);

/// (J/m²) Spent for good once the opening has been as large as δmax: ½σcδmax, up to Gc = ½σcδc. It
/// is the area below the envelope less what is recoverable at δmax.
[[nodiscard]] double spentEnergy(double strength, double criticalOpening, double largestOpening);

/// (J/m²) Given back when closing from δ, at or below δmax: ½T(δmax)δ²/δmax.
[[nodiscard]] double recoverableEnergy(double strength, double criticalOpening,
                                       double largestOpening, double opening);

/// (Pa) What the law puts against a motion that would end at the opening `trial` (m, ≥ 0) without
/// it. `compliance`: k (m/Pa), what a traction takes from the opening. While the opening grows it
/// is the envelope at δmax, the largest opening before the step: then the leapfrog's work is a
/// trapezoid sum, exact for a line. Where that much would close the edge below the unloading line,
/// it is what ends on that line: T = T(δmax)·δ/δmax with δ = δ* − kT, implicit, so that the
/// stiffest line does no harm. With δmax = 0 it holds the edge closed as long as T ≤ σc suffices:
/// the bounded multiplier.
[[nodiscard]] double cohesiveTraction(double strength, double criticalOpening,
                                      double largestOpening, double trial, double compliance);

}  // namespace yadefrag
