#pragma once

#include <cstddef>

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

}  // namespace yadefrag
