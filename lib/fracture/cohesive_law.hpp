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
//
//   Shear has its own strength βσc and its own work GII = κGc (Snozzi and Molinari 2013, Int. J.
//   Numer. Meth. Eng. 93, 510): of a normal opening δₙ and a slip δₛ,
//     δ = √(δₙ² + (β²/κ²)δₛ²),  Tₙ = T δₙ/δ,  Tₛ = T (β²/κ)δₛ/δ.
//   Faces that are pressed together push, and rub beside that: |τ| ≤ μp against the slip.

namespace yadefrag {

/// (Pa) Most that an edge of strength σc (Pa) holds when opened further than ever, to δ (m).
[[nodiscard]] double envelope(double strength, double criticalOpening, double opening);

/// (J/m²) Spent for good once the opening has been as large as δmax: ½σcδmax, up to Gc = ½σcδc. It
/// is the area below the envelope less what is recoverable at δmax.
[[nodiscard]] double spentEnergy(double strength, double criticalOpening, double largestOpening);

/// (J/m²) Given back when closing from δ, at or below δmax: ½T(δmax)δ²/δmax.
[[nodiscard]] double recoverableEnergy(double strength, double criticalOpening,
                                       double largestOpening, double opening);

/// (m) The opening by which one end of an edge holds, from the largest of its own and of the other
/// end: its own while they are alike, their mean where they differ by δc or more. An edge that
/// opens at one end only, like a door, is then through once it has spent Gc on its whole length. By
/// each end's own opening the shut end would stay a hinge that bears half of the edge's strength
/// for ever: thin rings unfolded like a zigzag. The blend's power leaves alone what a mesh
/// resolves: in a zone of four elements the ends differ by δc/4, and the mean counts by 3 %.
[[nodiscard]] double countedOpening(double own, double other, double criticalOpening);

/// Across a crack and along it.
struct AcrossAlong {
  double normal, shear;
};

/// How the faces of a crack hold each other in one step.
struct CohesiveHold {
  double most;             ///< Pa, the envelope at δmax
  double largest;          ///< m, δmax, before the step
  double shearFactor;      ///< β
  double shearRatio;       ///< β²/κ
  double friction;         ///< μ
  AcrossAlong compliance;  ///< m/Pa: what a traction takes from the opening, by direction
};

struct FaceTractions {
  double normal = 0;    ///< Pa, positive: pulls the faces together
  double shear = 0;     ///< Pa, of the law alone
  double friction = 0;  ///< Pa, along the face, too
};

/// (m) δ; faces that overlap are shut.
[[nodiscard]] double effectiveOpening(AcrossAlong opening, double shearFactor, double shearRatio);

/// (Pa) Against a motion that would end at the opening `trial` (m) without them. `slid`: m, the
/// slip at the step's begin, which friction keeps as far as it can.
///
/// While the opening grows the law gives T(δmax), the envelope at the largest opening before the
/// step: then the leapfrog's work is a trapezoid sum, exact for a line. Its direction is that of
/// the opening at the step's end. Where that much would close the edge below the unloading line,
/// the tractions are those that end on that line, implicit, so that the stiffest line does no harm.
/// With δmax = 0 they hold the edge closed as long as √(Tₙ² + (Tₛ/β)²) ≤ σc suffices, and go on
/// from there without a jump, in both directions: the bounded multiplier.
[[nodiscard]] FaceTractions faceTractions(const CohesiveHold& hold, AcrossAlong trial, double slid);

}  // namespace yadefrag
