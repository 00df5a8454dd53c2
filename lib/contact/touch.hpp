#pragma once

#include <algorithm>
#include <cassert>
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

/// The same for slaves in ascending order, without a search for each.
class TouchCursor {
 public:
  explicit TouchCursor(std::span<const Touch> touches) : rest_(touches) {
    assert(std::ranges::is_sorted(touches, {}, &Touch::pair));
  }
  std::span<const Touch> of(EntryId slave) {
    std::size_t begin = 0;
    while (begin < rest_.size() && rest_[begin].pair.slave < slave) ++begin;
    rest_ = rest_.subspan(begin);
    std::size_t end = 0;
    while (end < rest_.size() && rest_[end].pair.slave == slave) ++end;
    return rest_.first(end);
  }

 private:
  std::span<const Touch> rest_;
};

/// The one with this master, or null.
inline const Touch* touchOn(std::span<const Touch> ofSlave, EntryId master) {
  for (const Touch& touch : ofSlave)
    if (touch.pair.master == master) return &touch;
  return nullptr;
}

}  // namespace yadefrag
