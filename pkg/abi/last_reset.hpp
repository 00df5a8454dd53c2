#pragma once
// The one member of ForceContainer that is read: without YADE's headers, at its place in the layout
// table.

#ifdef YADEFRAG_YADE_SOURCE
#include "abi/source_headers.hpp"
#else
#include <cstring>

#include "abi/force_container.hpp"
#include "abi/layout.hpp"
#endif

namespace yadefrag {

/// Step of the last reset of forces.
inline long lastReset(const yade::ForceContainer& forces) {
#ifdef YADEFRAG_YADE_SOURCE
  return forces.lastReset;
#else
  long step;
  const auto* const begin = reinterpret_cast<const unsigned char*>(&forces);
  std::memcpy(&step, begin + layoutBytes("ForceContainer", "lastReset"), sizeof step);
  return step;
#endif
}

}  // namespace yadefrag
