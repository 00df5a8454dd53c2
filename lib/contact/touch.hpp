#pragma once

#include <algorithm>
#include <span>

#include "contact/candidates.hpp"

namespace yadefrag {

/// Data of an active that are stored for the next step.
struct Touch {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, start values of the next solution
  double toleratedGap;               ///< m, ≤ 0: the rest of an overlap older than the contact
};

/// The contacts of a slave among `touches` (by pair).
inline std::span<const Touch> touchesOf(std::span<const Touch> touches, EntryId slave) {
  const auto slaveOf = [](const Touch& touch) { return touch.pair.slave; };
  const auto begin = std::ranges::lower_bound(touches, slave, {}, slaveOf);
  return {begin, std::ranges::upper_bound(begin, touches.end(), slave, {}, slaveOf)};
}

}  // namespace yadefrag
