#pragma once
// Tolerances and thresholds of the searches and of what is periodic, each with its unit and its
// reason.

#include <cstddef>
#include <cstdint>

namespace yadefrag::tolerance {

/// (relative) Margin of the largest box of a level, which is subtracted from a coordinate. It
/// covers the rounding of the two subtractions (2⁻⁵³ each) eight times.
inline constexpr double kExtentRounding = 8.9e-16;

/// (ratio) Edge of a position-code box over the longest body box of its level. Above 1, a box that
/// overlaps another starts in the same position-code box or in the next one; the search depends on
/// that. A larger ratio gives fewer ranges and more candidates: see tests/benchmark.
inline constexpr double kEdgeOverExtent = 2;

/// (ratio) The same for codes row by row. A row is scanned as a whole whatever the edge, so that
/// the shortest possible edge gives the fewest candidates. The excess over 1 covers the rounding of
/// coordinates, at most 2⁻²³ of an edge.
inline constexpr double kRowEdgeOverExtent = 1.001;

/// (count) Boxes per edge along a row, a power of two. Boxes that overlap start within one edge of
/// each other: the finer its division, the fewer others are tested, and the more often a box that
/// moves gets another code.
inline constexpr int kPartsOfX = 2;

/// (ratio) Rows in a sweep are used if at least this part of the boxes can be on one level: sizes
/// of 1 : 10 take .3 (2D) to .5 times (3D) as long as on the curve. Of sizes of 1 : 1000 a tenth is
/// on one level: .6 (2D) to 1.5 times (3D).
inline constexpr double kEven = .25;

/// (ratio) Rows are used, and their level keeps its size, until the part that counts has fallen by
/// this: in flat distributions of sizes the best level would change with every sample.
inline constexpr double kStillEven = .8;

/// (codes) The begin of a row is searched this far from the last one, code by code, before larger
/// strides are taken.
inline constexpr int kRowSteps = 8;

/// (codes) The look-up of a row takes as long as a scan of so many codes.
inline constexpr std::uint64_t kCodesPerRow = 16;

/// (count) Size of the sample of boxes from which the levels are planned.
inline constexpr std::size_t kSample = 1024;

/// (ratio) The longest side of a level is planned this much longer than the longest side of the
/// sample. Bodies of one size differ by rounding and by their sweeps; the margin keeps them on one
/// level.
inline constexpr double kSpareSide = 1.1;

/// (count) Levels with no more boxes than this are not put on the curve; their boxes are tested
/// against all others. Otherwise a floor and four walls would cost every body a range search each.
inline constexpr std::size_t kWideLevelCount = 8;

/// (count) A directory slot with more codes than this gets a directory of its own.
inline constexpr std::size_t kBucketCodes = 16;

/// (boxes) A rectangle up to this width on every axis is cut once per axis (paper §4.4). A larger
/// one is cut until its ranges contain few other boxes.
inline constexpr double kSmallRectangle = 3;

/// (boxes) A level is merged into the next coarser one if it has at most this many boxes per
/// occupied position-code box of twice the edge.
inline constexpr double kThinLevel = 1.5;

/// (ratio) With at least this many boxes on a finer level per box on a coarser one, the boxes of
/// the coarser level search the finer one.
inline constexpr std::size_t kFinePerCoarse = 4;

/// (boxes) An axis is left out of the position code if all boxes start within this many median box
/// lengths on it: a plane scene is searched with 2D codes.
inline constexpr double kFlatAxis = 1.0;

/// (ratio) Maximum number of codes in a range of a large rectangle per box of the rectangle:
/// between the two end codes of a thin rectangle may lie the whole scene.
inline constexpr std::uint64_t kCodesPerBox = 4;

/// (count) Lists of at least this length are sorted by digits (radix sort); shorter ones have fewer
/// entries than the sort has counters.
inline constexpr std::size_t kRadixLength = 256;

/// (ratio) The hierarchy is rebuilt when the total half-perimeter of its refitted nodes exceeds
/// this multiple of its value after building.
inline constexpr double kHierarchyDecay = 1.5;

/// (count) Boxes in a leaf of the hierarchy.
inline constexpr std::uint32_t kHierarchyLeaf = 4;

/// (count) Rows of a pair table longer than this are sorted and searched by bisection; for shorter
/// ones a linear search is as fast. Few bodies of an even packing have so many neighbours.
inline constexpr std::size_t kLongRow = 16;

/// (box tests per box) Changed boxes are kept in a separate search. They are sorted into the main
/// one when the tests in the separate search exceed this multiple of the number of all boxes:
/// sorting in costs one access per box.
inline constexpr std::size_t kAsideWork = 1;

/// (relative to squared lengths) A period vector counts as shorter than another only if the
/// difference exceeds rounding. Vectors of equal length are therefore not swapped repeatedly.
inline constexpr double kShorterPeriod = 1e-12;

/// (cells) Largest shear of a periodic cell. Reducing the vectors loses as many digits as the shear
/// has.
inline constexpr double kMostShear = 1e6;

}  // namespace yadefrag::tolerance
