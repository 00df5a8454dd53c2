#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

/// The state of the global search: what it covers, and until when.
struct SearchState {
  double halo = 0;      ///< m, δ of the last search
  double shortest = 0;  ///< m, shortest boundary segment then
  bool isDue = true;    ///< the next step may leave the halo
  bool isVoid = true;   ///< entries came or went: there are no candidates to go on with
  /// Of the surfaces of bodies that are not apart from all others; those that came by cracks are
  /// the last ones.
  std::vector<NodeId> nodes;
  std::vector<Vec2> positions;  ///< m, of those nodes at the last search, or when they came
};

}  // namespace yadefrag
