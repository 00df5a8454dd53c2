#pragma once
// What is read of YADE's containers without its functions.

#include <cstddef>
#include <cstring>

#include "abi/yade.hpp"

namespace yadefrag {

/// Null if the body was erased, or if there are not so many.
inline const yade::Body* bodyAt(const std::vector<yade::shared_ptr<yade::Body>>& bodies,
                                std::size_t id) {
  return id < bodies.size() ? bodies[id].get() : nullptr;
}
inline const yade::Body* bodyAt(const std::vector<yade::shared_ptr<yade::Body>>& bodies,
                                yade::Body::id_t id) {
  return bodyAt(bodies, static_cast<std::size_t>(id));
}
inline const yade::Body* bodyAt(const yade::Scene& scene, yade::Body::id_t id) {
  return bodyAt(scene.bodies->body, id);
}

/// Step of the last reset of forces: without YADE's headers, at its place in the layout table.
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
