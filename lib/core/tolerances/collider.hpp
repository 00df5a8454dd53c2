#pragma once
// Tolerances and thresholds of the colliders (pkg/collider), each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (relative to coordinates) Covers the rounding of the test of the true halo and of YADE's
/// geometry functors, so that balls that touch to the last bit are not lost where there is no
/// sweep.
inline constexpr double kHaloRounding = 2e-15;

/// (bytes) Memory of a potential interaction with its pair in the search, and what contact adds to
/// it (measured: 417; 380 to 660).
inline constexpr double kPairBytes = 420, kContactBytes = 650;

/// (count) Pairs per body of which few are contacts; where there are more, bodies lie on one
/// another and all of them may be.
inline constexpr double kUsualPairs = 20;

/// (count; ratio) Bodies below which all pairs fit any memory, and how much their number may grow
/// before the free memory is looked up again.
inline constexpr std::size_t kFewBodies = 4000;
inline constexpr double kMemoryLookUp = 1.1;

/// (ratio) Spare in the length of a sweep for acceleration: without it a body at constant speed
/// calls for a search one step early.
inline constexpr double kSweepSpare = 1.02;

/// (ratio) A body whose room is longer than this many times what its present speed asks for gets a
/// new one: bodies that come to rest would otherwise keep neighbours that they cannot reach.
inline constexpr double kLooseSweep = 4;

/// (of the interval) For how long a body's room must last to be kept when others are searched: less
/// means more searches, more means that rooms are given up early.
inline constexpr double kLookAhead = .25;

/// (of a body's share in a search of all) Work of the look whether a body has left its room, which
/// is to fetch it from memory, and of the search of one that has (measured: 0.05 and 1.8 of 0.33
/// µs).
inline constexpr double kLookWork = .15, kChangeWork = 6;

/// (steps) Shortest and longest interval between searches that is aimed at.
inline constexpr double kLeastInterval = 3, kMostInterval = 200;

/// (ratio) Growth of the interval from one search to the next. Growth is blind: in a dense block a
/// whole shell of further neighbours comes near at once. Small steps overshoot little.
inline constexpr double kIntervalGrowth = 1.25;

/// (of its radius) A sphere that is farther from the plane of the bodies is meant to be beside it:
/// rounding of a place gives a billionth.
inline constexpr double kInPlane = 1e-6;

/// (of the shorter one) Ends of two facets this near to each other are one place: vertices that a
/// file gives with six digits.
inline constexpr double kMeet = 1e-6;

/// (of the bodies' extent) Half the length of a wall, which has no ends, and how much of it must be
/// left past any body: it then need not be shifted for long.
inline constexpr double kWallReach = 20, kWallLeft = 2;

}  // namespace yadefrag::tolerance
