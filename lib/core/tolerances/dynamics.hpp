#pragma once
// Tolerances and thresholds of internal forces and of the time integration, each with its unit and
// its reason.

#include <cstddef>

#include "core/tolerances/threads.hpp"

namespace yadefrag::tolerance {

/// (m/s) Highest speed that a velocity may have or be prescribed: the speed squared and the
/// displacement in a step stay finite numbers.
inline constexpr double kMostSpeed = 1e100;

/// (1) Largest coefficients of bulk viscosity. Usual ones are 0.06 and 1.2; the critical time step
/// falls in proportion.
inline constexpr double kMostViscosity = 1e6;

/// (det F; of the least stress-free height) An element compressed to `kFlat` of its area is flat.
/// An element can be inverted in one step only if it is flat or if one of its nodes moves by
/// `kLargeMove` or more; elements that are also stretched in one direction are the exception.
inline constexpr double kFlat = .3, kLargeMove = .1;

/// (det F) Below this part of its area the barrier against collapse acts on an element. It is below
/// kFlat, so that a step without large moves that ends in the barrier starts flat.
inline constexpr double kBarrierBegin = .2;

/// (count) Elements per block in the sum of forces. The nodes of a block stay in the first-level
/// cache, and few of them belong to another block.
inline constexpr std::size_t kChunkElements = 512;

/// (ratio) Elements stressed to this part of their body's lowest strength are checked in detail.
/// The margin is needed since the stress is that of the previous step.
inline constexpr double kStrengthCheck = .9;

/// (ratio) Minimum number of elements per thread, as a multiple of the minimum for other items:
/// threads wait for each other twice a step.
inline constexpr std::size_t kElementsPerItem = 4;

/// (count) Nodes per block in sums over nodes. The blocks are fixed, so that sums do not depend on
/// the number of threads.
inline constexpr std::size_t kNodesPerSum = 2048;

/// (kg) Mass of a node of a rigid boundary, whose motion is prescribed. It is above 0, because mass
/// 0 marks nodes of removed triangles, and so small that it changes no sum of masses.
inline constexpr double kRigidMass = 1e-300;

/// (of ω²) Margin of the critical step for an element in the barrier, whose stiffness grows within
/// a step. With 1, 4, 9, 16 a column that hits a wall at 1.5 of the wave speed gains 4, 1.2, .3, .2
/// % of its energy.
inline constexpr double kBarrierGrowth = 9;

/// (ratio) The step that is advised for a collapsing element, of the critical one: the element gets
/// flatter still.
inline constexpr double kBarrierAdvised = .5;

// --- Tolerances of materials that yield, each with its unit and its reason.

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
/// (ratio) A single step does not reduce O.dt by more: such triangles are as good as inverted.
inline constexpr double kLeastFlowStep = .01;

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
