#pragma once

#include <algorithm>
#include <cmath>

#include "abi/yade.hpp"

namespace yadefrag {

/// The smaller friction coefficient of two bodies' materials, which most of YADE's laws use.
inline double smallerFriction(const yade::Scene& scene, yade::Body::id_t one,
                              yade::Body::id_t other) {
  double least = INFINITY;
  for (const auto id : {one, other}) {
    const yade::Body& body = *scene.bodies->body[static_cast<std::size_t>(id)];
    const auto* material = dynamic_cast<const yade::FrictMat*>(body.material.get());
    least = std::min(least, material ? std::tan(material->frictionAngle) : 0);
  }
  return least;
}

}  // namespace yadefrag
