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

}  // namespace yadefrag::tolerance
