#pragma once
// The cohesive law: tractions on an edge that has begun to open.

#include "mesh/softening_curve.hpp"

namespace yadefrag {

/// The law of an edge in tension.
struct TensionLaw {
  const SofteningCurve& curve;
  double strength;         ///< Pa, σc
  double criticalOpening;  ///< m, δc
};

/// (Pa) Largest traction when the edge opens beyond its largest opening, to δ (m).
[[nodiscard]] double envelope(const TensionLaw& law, double opening);

/// (J/m²) Dissipated energy after a largest opening of δmax, up to Gc; ½σcδmax for the straight
/// line. It is the area below the envelope minus the energy that is recoverable at δmax.
[[nodiscard]] double spentEnergy(const TensionLaw& law, double largestOpening);

/// (m) The effective opening of one end of an edge, as a function of the largest openings of this
/// end and of the other one: its own opening while both are similar, the mean where they differ by
/// δc or more. An edge that opens at one end only, like a hinge, is then broken when it has
/// dissipated Gc on its whole length. With each end's own opening the closed end would remain a
/// hinge that carries half of the edge's strength for ever: thin rings unfolded in a zigzag. The
/// power of the blend is chosen so that resolved cracks do not change: in a zone of four elements
/// the ends differ by δc/4, and the weight of the mean is 3 %.
[[nodiscard]] double countedOpening(double own, double other, double criticalOpening);

/// Components across a crack and along it.
struct AcrossAlong {
  double normal, shear;
};

/// State of one end of a crack in one step.
struct CohesiveHold {
  double most;             ///< Pa, the envelope at δmax
  double largest;          ///< m, δmax, before the step
  double shearFactor;      ///< β
  double shearRatio;       ///< β²/κ
  double friction;         ///< μ
  AcrossAlong compliance;  ///< m/Pa: closing per traction, by direction
};

struct FaceTractions {
  double normal = 0;    ///< Pa, positive: pulls the faces together
  double shear = 0;     ///< Pa, of the law only
  double friction = 0;  ///< Pa, along the face
};

/// (m) δ; faces that overlap count as closed.
[[nodiscard]] double effectiveOpening(AcrossAlong opening, double shearFactor, double shearRatio);

/// (Pa) Tractions for a motion that would end at the opening `trial` (m) without them. `slid`: m,
/// the slip at the begin of the step, which friction retains as far as possible.
///
/// While the opening grows, the traction is T(δmax), the envelope at the largest opening before the
/// step: the leapfrog's work is then a trapezoid sum, exact on each line of the curve. Its
/// direction is that of the opening at the end of the step. If T(δmax) would close the edge below
/// the unloading line, the tractions are those that end on that line; this is implicit and
/// therefore stable for any stiffness of the line. With δmax = 0 the tractions keep the edge closed
/// as long as √(Tₙ² + (Tₛ/β)²) ≤ σc, and continue from there without a jump, in both directions: a
/// bounded multiplier.
[[nodiscard]] FaceTractions faceTractions(const CohesiveHold& hold, AcrossAlong trial, double slid);

}  // namespace yadefrag
