#pragma once
// Bodies by id, vectors of the plane z = 0, what is read of YADE's objects without its functions.

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/vec2.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

// Points of the plane as YADE's vectors in space, and back.
inline Vec2 inPlane(const yade::Vector3r& v) { return {v[0], v[1]}; }
inline yade::Vector3r inSpace(Vec2 v) { return {v.x, v.y, 0}; }

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

/// As many as its ompThreads, or all.
inline int threadsOf(const yade::Engine& engine) {
  const int most = omp_get_max_threads();
  return engine.ompThreads > 0 ? std::min(engine.ompThreads, most) : most;
}

/// The friction coefficient of a body's material; 0 without one.
inline double frictionOf(const yade::Body& body) {
  const auto* material = dynamic_cast<const yade::FrictMat*>(body.material.get());
  return material ? std::tan(material->frictionAngle) : 0;
}

/// The smaller one of two bodies, which most of YADE's laws use.
inline double smallerFriction(const yade::Scene& scene, yade::Body::id_t one,
                              yade::Body::id_t other) {
  return std::min(frictionOf(*bodyAt(scene, one)), frictionOf(*bodyAt(scene, other)));
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
