#pragma once

#include "core/tolerances/contact.hpp"

namespace yadefrag {

struct ContactSettings {
  /// 1: of two surfaces the points of the finer one are slaves, and the sharp corners of the other.
  /// 2: every point of both.
  int passes = 1;
  /// Width of the halo over the shortest segment; 0: determined by the bodies' speed.
  double halo = 0;
  tolerance::Contact constants = {};  ///< tests halve and double each of them
};

}  // namespace yadefrag
