#pragma once
// Tolerances and thresholds of the work for several threads, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (count) With fewer items than this a second thread costs more than it saves.
inline constexpr std::size_t kMinItemsPerThread = 512;

}  // namespace yadefrag::tolerance
