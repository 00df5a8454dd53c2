#pragma once

#include "contact/candidates.hpp"

namespace yadefrag {

/// What the next step has to know of an active.
struct Touch {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, where the next solve starts from
  double allowed;  ///< m, ≤ 0: what is left of an overlap older than the contact
};

}  // namespace yadefrag
