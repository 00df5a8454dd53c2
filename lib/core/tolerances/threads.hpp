#pragma once
// Tolerances and thresholds of the work for several threads, each with its unit and its reason.

#include <cstddef>

namespace yadefrag::tolerance {

/// (count) Fewer items than this are not worth waking a second thread for.
#ifdef YADEFRAG_ITEMS_PER_THREAD  // the thread sanitizer is to see threads in small scenes
inline constexpr std::size_t kMinItemsPerThread = YADEFRAG_ITEMS_PER_THREAD;
#else
inline constexpr std::size_t kMinItemsPerThread = 512;
#endif

}  // namespace yadefrag::tolerance
