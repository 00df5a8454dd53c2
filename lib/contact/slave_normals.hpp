#pragma once

#include <algorithm>
#include <cmath>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

/// True if two adjacent pieces with these unit normals are one face for a slave that slides;
/// `faceAngle`: a sine.
inline bool areOneFace(Vec2 a, Vec2 b, double faceAngle) {
  return dot(a, b) > 0 && std::abs(cross(a, b)) < faceAngle;
}

/// The slave's outward normals: those of the previous piece and of its own piece. A convex corner
/// has these two and all normals in between. The two sides of a splinter are not opposed to the
/// face that its tip touches. A sharp corner with one side on the master's inner side has come past
/// the master's end: the contact is then between its other side and that end, or between the
/// master's end and the slave's side.
struct SlaveNormals {
  Vec2 before, after;
  [[nodiscard]] bool oppose(Vec2 normal, const tolerance::Contact& constants) const {
    const bool convex = cross(before, after) > 0 || dot(before, after) < tolerance::kFolded;
    const double leaning = std::min(cross(normal, before), cross(after, normal));
    if (convex && leaning >= 0) return true;
    const bool sharp = convex && !areOneFace(before, after, constants.faceAngle);
    if (sharp && leaning < -constants.faceAngle) return false;
    return std::min(dot(before, normal), dot(after, normal)) < constants.opposed;
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
