#pragma once
// Tolerances and thresholds of the searches and of what is periodic, each with its unit and its
// reason.

#include <cstddef>
#include <cstdint>

namespace yadefrag::tolerance {

/// (relative) Added to the largest box of a level before it is subtracted from a coordinate: covers
/// the rounding of the two subtractions (2⁻⁵³ each) with a factor of eight to spare.
inline constexpr double kExtentRounding = 8.9e-16;

/// (ratio) Edge of a position-code box over the longest body box of its level. Above 1, a box that
/// overlaps another starts in the same position-code box or the next, which the search relies on.
/// The greater, the fewer ranges and the more candidates: see tests/benchmark.
inline constexpr double kEdgeOverExtent = 2;

/// (count) Boxes from whose sizes the levels are planned.
inline constexpr std::size_t kSample = 1024;

/// (ratio) The longest side of a level is planned by this much above the longest of the sample, so
/// that bodies of one size, which differ by rounding and by their sweeps, do not straddle two
/// levels.
inline constexpr double kSpareSide = 1.1;

/// (count) Levels with no more boxes than this are not put on the curve but tested against
/// everything: a floor and four walls would otherwise cost every body a range search each.
inline constexpr std::size_t kWideLevelCount = 8;

/// (count) Codes in one bucket of the directory above which the bucket gets a directory of its own.
inline constexpr std::size_t kBucketCodes = 16;

/// (boxes) Up to this width on every axis a rectangle is cut once an axis (paper §4.4); a larger
/// one is cut until its ranges hold little else.
inline constexpr double kSmallRectangle = 3;

/// (boxes) Up to this many per occupied position-code box of twice the edge, a level is joined to
/// the next coarser one.
inline constexpr double kThinLevel = 1.5;

/// (ratio) From this many boxes on a finer level per box on a coarser one, the coarse ones search.
inline constexpr std::size_t kFinePerCoarse = 4;

/// (boxes) An axis along which all boxes start within this many median box lengths is left out of
/// the position code: a plane scene is searched with 2D codes.
inline constexpr double kFlatAxis = 1.0;

/// (ratio) Codes that a range of a large rectangle may hold for each of its boxes: a sliver's two
/// end codes can have the whole scene between them.
inline constexpr std::uint64_t kCodesPerBox = 4;

/// (count) From this length on a list is sorted by digits; a shorter one has fewer entries than
/// there are counters.
inline constexpr std::size_t kRadixPays = 256;

/// (ratio) The hierarchy is rebuilt when the summed half-perimeter of its refitted nodes exceeds
/// this many times what it was when built.
inline constexpr double kHierarchyDecay = 1.5;

/// (count) Boxes in a leaf of the hierarchy.
inline constexpr std::uint32_t kHierarchyLeaf = 4;

/// (count) Rows of a table of pairs that are longer are sorted and halved to find a pair: below
/// that a look at each is as fast. Few bodies of an even packing have as many neighbours.
inline constexpr std::size_t kLongRow = 16;

/// (looks per box) Boxes that changed are sorted in when those that wait were looked at this many
/// times the number of all: to sort in costs one look at each.
inline constexpr std::size_t kAsideWork = 1;

/// (relative to squared lengths) A period vector is taken for shorter than another only beyond
/// rounding, so that equal ones do not take turns.
inline constexpr double kShorterPeriod = 1e-12;

/// (cells) Largest shear of a periodic cell. Reduced vectors lose as many digits as it has.
inline constexpr double kMostShear = 1e6;

}  // namespace yadefrag::tolerance
