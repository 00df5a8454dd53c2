#pragma once
// How many boxes a search can count.

#include <cstddef>
#include <cstdint>

#include "core/errors.hpp"

namespace yadefrag {

/// Slots are counted in 32 bits, of which a directory and a tree use one for themselves.
inline constexpr std::size_t kMostBoxes = (std::size_t{1} << 31) - 1;

/// Throws RunError for more boxes than can be counted.
inline void checkBoxCount(std::size_t count) {
  if (count > kMostBoxes)
    throw RunError("A search takes 2147483647 boxes at most, periodic copies included.");
}

}  // namespace yadefrag
