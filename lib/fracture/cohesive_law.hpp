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

#include <algorithm>
#include <cmath>

namespace yadefrag {

/// (m) δ = √(δₙ⁺² + β²δₛ²), δₙ⁺ the normal opening where it is one (Camacho and Ortiz 1996; Ortiz
/// and Pandolfi 1999, Int. J. Numer. Meth. Eng. 44, 1267). The work of T over δ is that of the
/// tractions T·δₙ⁺/δ along the normal and β²T·δₛ/δ along the face.
[[nodiscard]] inline double effectiveOpening(double normal, double shear, double shearFactor) {
  return std::hypot(std::max(0., normal), shearFactor * shear);
}

/// (Pa) Most that an edge of strength σc (Pa) holds when opened further than ever, to δ (m).
[[nodiscard]] double envelope(double strength, double criticalOpening, double opening);

/// (J/m²) Spent for good once the opening has been as large as δmax: ½σcδmax, up to Gc = ½σcδc. It
/// is the area below the envelope less what is recoverable at δmax.
[[nodiscard]] double spentEnergy(double strength, double criticalOpening, double largestOpening);

/// (J/m²) Given back when closing from δ, at or below δmax: ½T(δmax)δ²/δmax.
[[nodiscard]] double recoverableEnergy(double strength, double criticalOpening,
                                       double largestOpening, double opening);

/// (Pa) The traction T ≥ 0 with which the law holds at the END of a step.
/// `trial`: δ* (m, ≥ 0), where the opening would end without T. `compliance`: k (m/Pa), what T
/// takes from it, δ = δ* − kT. Then (δ, T) is on the unloading line where δ ≤ δmax, and on the
/// envelope beyond; with δmax = 0, T holds the edge closed as long as T ≤ σc: the bounded
/// multiplier. Implicit and in closed form, so that the stiffest line does no harm: δ and T hang on
/// δ* continuously, and δ grows with it.
///
/// Where k ≥ δc/σc, the envelope is steeper than inertia and no δ between δmax and δc can be an
/// end: T holds on the unloading line as long as that suffices, up to T(δmax); beyond, the edge
/// snaps: T = 0 at δ = δ* ≥ δc. Every end is still on the law; but of the energy between δmax and
/// δc only the law keeps account, not the motion, so `checkCohesiveResolution` refuses such steps
/// beforehand.
[[nodiscard]] double cohesiveTraction(double strength, double criticalOpening,
                                      double largestOpening, double trial, double compliance);

}  // namespace yadefrag
