#pragma once
// Tolerances and thresholds of internal forces and of the time integration, each with its unit and
// its reason.

#include <cstddef>

#include "core/tolerances/threads.hpp"

namespace yadefrag::tolerance {

/// (m/s) Speed limit of the motion watch where no lower one is set: its square, and the way in a
/// step, are finite. No velocity may be prescribed above it.
inline constexpr double kAnySpeed = 1e100;

/// (1) Largest coefficients of bulk viscosity: usual ones are 0.06 and 1.2, and the critical step
/// falls in proportion.
inline constexpr double kMostViscosity = 1e6;

/// (det F; of the least stress-free height) An element that is compressed to `kFlat` of its area is
/// flat. Only a flat element, or one whose nodes move by `kSwift` or more, can be turned inside out
/// in one step; elements that were stretched as well are the exception.
inline constexpr double kFlat = .2, kSwift = .1;

/// (count) Elements whose forces are summed in one go: their nodes stay in the first-level cache,
/// and few of them belong to another chunk too.
inline constexpr std::size_t kChunkElements = 512;

/// (ratio) Elements stressed to this part of their body's lowest strength are looked at more
/// closely: the stress is that of the step before.
inline constexpr double kStrengthLook = .9;

/// (ratio) Elements of a thread's part, at least, to other items: the threads meet twice a step.
inline constexpr std::size_t kElementsPerItem = 4;

/// (count) Nodes whose works are summed in one go: sums do not depend on the number of threads.
inline constexpr std::size_t kNodesPerSum = 2048;

/// (kg) Of a node of a rigid boundary, which moves as it is given: above 0, for nodes of dropped
/// triangles have 0, and so little that no sum over masses changes by it.
inline constexpr double kRigidMass = 1e-300;

}  // namespace yadefrag::tolerance
