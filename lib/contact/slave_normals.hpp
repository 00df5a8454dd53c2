#pragma once

#include <algorithm>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// The slave's outward normals, of the piece before it and of its own: a corner has two, and if it
/// is convex all between them. The two sides of a splinter do not oppose what its tip pricks. A
/// sharp corner one of whose sides lies on the master's inner side has come past the master's end,
/// where the other side of it touches, or that end touches the slave's side.
struct SlaveNormals {
  Vec2 before, after;
  [[nodiscard]] bool oppose(Vec2 normal) const {
    const bool convex = cross(before, after) > 0 || dot(before, after) < tolerance::kFolded;
    const double leaning = std::min(cross(normal, before), cross(after, normal));
    if (convex && leaning >= 0) return true;
    const bool sharp = convex && dot(before, after) < tolerance::kSameFace;
    if (sharp && leaning < -tolerance::kLeansIn) return false;
    return std::min(dot(before, normal), dot(after, normal)) < tolerance::kOpposed;
  }
};

template <class Geometry>
SlaveNormals slaveNormals(const ContactSurfaces& surfaces, const Geometry& geometry,
                          EntryId slave) {
  const EntryId former = surfaces.prev[slave.value];
  return {geometry.normal(former, geometry.range(former).end),
          geometry.normal(slave, geometry.range(slave).begin)};
}

}  // namespace yadefrag
