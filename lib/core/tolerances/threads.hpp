#pragma once
// Tolerances and thresholds of the work for several threads, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (count) With fewer items than this a second thread costs more than it saves.
inline constexpr std::size_t kMinItemsPerThread = 512;

/// (count) Items of different size that a thread takes at once.
inline constexpr int kItemsAtOnce = 16;

/// (bytes) Distance of data that several threads change: two cache lines.
inline constexpr std::size_t kThreadsApart = 128;

}  // namespace yadefrag::tolerance
