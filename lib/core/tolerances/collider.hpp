#pragma once
// Tolerances and thresholds of the colliders (pkg/collider), each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (relative to coordinates) Covers the rounding of the true-halo test and of YADE's geometry
/// functors: spheres that touch exactly, in the last bit, are found also without a sweep.
inline constexpr double kHaloRounding = 2e-15;

/// (count) Fewer new interactions than this at once are created in any order; sorting them along
/// the curve would take longer than it saves.
inline constexpr std::size_t kFewNewPairs = 256;

/// (bytes) Memory of a potential interaction with its pair in the search, and additional memory of
/// a contact (measured: 417; 380 to 660).
inline constexpr double kPairBytes = 420, kContactBytes = 650;

/// (count) Pairs per body up to which few pairs are contacts. Above it, bodies overlap massively,
/// and all pairs may be contacts.
inline constexpr double kUsualPairs = 20;

/// (count; ratio) Below this number of bodies all pairs fit into any memory. The free memory is
/// read again when the number of bodies has grown by this ratio.
inline constexpr std::size_t kFewBodies = 4000;
inline constexpr double kMemoryLookUp = 1.1;

/// (ratio) The sweep is this much longer than the speed requires, for acceleration. Without this
/// margin a body at constant speed requires a search one step early.
inline constexpr double kSweepSpare = 1.02;

/// (of its room's length) A sphere that has moved this far along its velocity is expected to keep
/// it.
inline constexpr double kStraight = .5;

/// (ratio) A body whose swept box is this many times longer than its present speed requires gets a
/// new one. Otherwise bodies that come to rest would keep neighbours out of their reach.
inline constexpr double kLooseSweep = 4;

/// (of the interval) When other bodies are searched, a body keeps its swept box only if that lasts
/// for at least this part of the interval. A smaller value causes more searches; a larger one
/// discards swept boxes too early.
inline constexpr double kLookAhead = .25;

/// (of a body's share in a full search) Cost of the test whether a body has left its swept box,
/// which is mostly memory access, and cost of searching one body that has (measured: 0.05 and 1.8
/// of 0.33 µs).
inline constexpr double kCheckWork = .15, kChangeWork = 6;

/// (steps) Target range of the interval between two searches.
inline constexpr double kLeastInterval = 3, kMostInterval = 200;

/// (ratio) Growth of the interval from one search to the next. The next interval's number of pairs
/// is not known in advance: in a dense block a whole shell of further neighbours comes within reach
/// at once. Small growth steps overshoot little.
inline constexpr double kIntervalGrowth = 1.25;

/// (ratio) It may shrink faster: with too long an interval every step takes long, with too short a
/// one only searches are too many.
inline constexpr double kIntervalShrinking = .5;

/// (ratio; count; exponent) Time of a search per body over that of a potential interaction per
/// step: about 0.25 µs over 0.06 µs while a scene fits into the processor's caches, over 0.3 µs if
/// every interaction is read from memory (2-core machine, November 2026). The caches are full at
/// kCachedBodies to 10⁵ bodies, between which the ratio decreases by this power.
inline constexpr double kSearchOverPair = 4, kLeastSearchOverPair = 1.5;
inline constexpr double kCachedBodies = 3000, kCacheExponent = .4;

/// (of its radius) A sphere farther from the plane of the bodies than this is deliberately out of
/// plane: rounding of a position is about 1e-9.
inline constexpr double kInPlane = 1e-6;

/// (of the shorter one) Ends of two facets nearer to each other than this coincide: files give
/// vertices with six digits.
inline constexpr double kMeet = 1e-6;

/// (of the bodies' extent) Half the length that represents a wall, which is infinite, and the
/// minimum length beyond any body. With these values the represented part is rarely shifted.
inline constexpr double kWallReach = 20, kWallMargin = 2;

}  // namespace yadefrag::tolerance
