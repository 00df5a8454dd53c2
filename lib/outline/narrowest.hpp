#pragma once
// The narrowest place of a polygon, in the body or in a gap, before there is a mesh.

#include <cstddef>
#include <vector>

#include "core/vec2.hpp"

namespace yadefrag {

struct NarrowPlace {
  double distance;     // m, of the corner from the nearest side that does not end at its place
  std::size_t corner;  // counted over all loops
};

/// The corner with the least distance from a side that does not end there; the first such corner.
/// `distance` is infinite if there is no such pair. Needs finite coordinates.
[[nodiscard]] NarrowPlace narrowestPlace(const std::vector<std::vector<Vec2>>& loops);

}  // namespace yadefrag
