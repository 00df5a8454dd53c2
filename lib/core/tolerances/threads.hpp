#pragma once
// Tolerances and thresholds of the work for several threads, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (count) Fewer items than this are not worth waking a second thread for.
inline constexpr std::size_t kMinItemsPerThread = 512;

}  // namespace yadefrag::tolerance
