#pragma once
// Tolerances of materials that yield, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (of the trial stress) Remaining distance from the yield surface at which the return ends: far
/// above rounding, so that Newton's method always reaches it.
inline constexpr double kReturned = 1e-11;

/// (count) Most iterations of a return. Newton's method needs three to six; each other one halves
/// the interval that contains the solution.
inline constexpr int kReturns = 60;

/// (ratio) Change of Δp by a step of the iteration with which it counts as converged: the error
/// falls with its third power, to 10⁻¹¹ of Δp.
inline constexpr double kLaneReturned = 2e-4;

/// (logarithmic strain) Largest change in a step for which the short series of `expOfTiny` is exact
/// to rounding.
inline constexpr double kTinyFlow = .02;

/// (squared logarithmic strain) Up to this the series of four terms of a logarithm is exact to
/// 10⁻¹⁴.
inline constexpr double kSeries = 1e-3;

/// (count) Groups of lanes per block of the vector loops: a block's values stay in the first-level
/// cache, and the steps of different groups do not wait for each other.
inline constexpr std::size_t kLaneBlock = 4;

/// (of the bulk modulus) Stress across the plane that counts as zero in plane stress.
inline constexpr double kNoStress = 1e-14;

/// (count) Most iterations for it; the method is Newton's.
inline constexpr int kThicknesses = 40;

/// (count) Newton steps for the thickness of an elastic triangle in plane stress, from that of the
/// last flow: the error of an elastic strain of 1 % is squared in each.
inline constexpr int kElasticThicknesses = 4;

/// (strain) Plastic strain of an initial stress up to which it is rounding: such a stress may lie
/// on the yield surface.
inline constexpr double kNoFlow = 1e-9;

/// (ratio) Growth of the steepest gradient of any triangle by flow, after which the critical step
/// is computed anew.
inline constexpr double kSteeper = .02;

/// (of the critical step) Step to which FESolver reduces O.dt after flow: the share that the manual
/// advises.
inline constexpr double kFlowStep = .8;

/// (ratio) Largest mean stress over von Mises' stress in the formula of the failure strain, as in
/// Johnson and Cook 1985, who bound it for lack of tests.
inline constexpr double kMostTriaxiality = 1.5;

/// (ratio) Plastic strain rate over the reference rate up to which the failure strain must be
/// positive: that of shock waves.
inline constexpr double kMostRate = 1e10;

/// Least failure strain, so that damage is finite at any rate: below the strain at the elastic
/// limit of any metal.
inline constexpr double kLeastFailureStrain = 1e-6;

/// (of von Mises' stress) Least traction on the edges of a triangle that has failed at which one
/// opens: below it, as under pressure, they would keep nothing of the strength that acts.
inline constexpr double kLeastOpening = .1;

/// (count, ratio) Sweeps over the nodes around a split, by which their volumes are matched, and the
/// share of each difference that a sweep removes. With these a split creates 1 to 5 % of the energy
/// of its crack, of either sign (1 to 12 % with 10 or 40 whole ones).
inline constexpr int kVolumeSweeps = 20;
inline constexpr double kVolumeShare = .5;

}  // namespace yadefrag::tolerance
