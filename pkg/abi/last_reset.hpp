#pragma once
// The one member of ForceContainer that is read, at its place in the layout table.

#include <cstring>

#include "abi/force_container.hpp"
#include "abi/layout.hpp"

namespace yadefrag {

/// Step of the last reset of forces.
inline long lastReset(const yade::ForceContainer& forces) {
  long step;
  const auto* const begin = reinterpret_cast<const unsigned char*>(&forces);
  std::memcpy(&step, begin + layoutBytes("ForceContainer", "lastReset"), sizeof step);
  return step;
}

}  // namespace yadefrag
