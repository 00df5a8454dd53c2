#pragma once

#include <algorithm>
#include <span>

#include "contact/candidates.hpp"

namespace yadefrag {

/// What the next step has to know of an active.
struct Touch {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, where the next solve starts from
  double allowed;  ///< m, ≤ 0: what is left of an overlap older than the contact
};

/// Those of a slave among `touches` (by pair).
inline std::span<const Touch> touchesOf(std::span<const Touch> touches, EntryId slave) {
  const auto slaveOf = [](const Touch& touch) { return touch.pair.slave; };
  const auto begin = std::ranges::lower_bound(touches, slave, {}, slaveOf);
  return {begin, std::ranges::upper_bound(begin, touches.end(), slave, {}, slaveOf)};
}

}  // namespace yadefrag
