#pragma once
// Tolerances of materials that yield, each with its unit and its reason.

namespace yadefrag::tolerance {

/// (of the trial stress) Remaining distance from the yield surface at which the return ends: far
/// above rounding, so that Newton's method always reaches it.
inline constexpr double kReturned = 1e-11;

/// (count) Most iterations of a return. Newton's method needs three to six; each other one halves
/// the interval that contains the solution.
inline constexpr int kReturns = 60;

/// (of the bulk modulus) Stress across the plane that counts as zero in plane stress.
inline constexpr double kNoStress = 1e-14;

/// (count) Most iterations for it; the method is Newton's.
inline constexpr int kThicknesses = 40;

/// (count) Newton steps for the thickness of an elastic triangle in plane stress, from that of the
/// last flow: the error of an elastic strain of 1 % is squared in each.
inline constexpr int kElasticThicknesses = 4;

/// (ratio) Growth of the steepest gradient of any triangle by flow, after which the critical step
/// is computed anew.
inline constexpr double kSteeper = .02;

/// (of the critical step) Step to which FESolver reduces O.dt after flow: the share that the manual
/// advises.
inline constexpr double kFlowStep = .8;

}  // namespace yadefrag::tolerance
