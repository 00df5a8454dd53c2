#pragma once
// Maximum number of boxes of a search.

#include <cstddef>
#include <cstdint>

#include "core/errors.hpp"

namespace yadefrag {

/// Slots are 32-bit numbers of which the directory and the tree use one bit as a flag.
inline constexpr std::size_t kMostBoxes = (std::size_t{1} << 31) - 1;

/// Throws RunError for more boxes than kMostBoxes.
inline void checkBoxCount(std::size_t count) {
  if (count > kMostBoxes)
    throw RunError("A search takes 2147483647 boxes at most, periodic copies included.");
}

}  // namespace yadefrag
