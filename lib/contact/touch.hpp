#pragma once

#include "contact/candidates.hpp"

namespace yadefrag {

/// Data of a row with a force that are stored for the next step.
struct Touch {
  SlaveMaster pair;
  double normalForce, tangentForce;  ///< N, start values of the next solution
  double toleratedGap;               ///< m, ≤ 0: the overlap that the row has left
};

}  // namespace yadefrag
