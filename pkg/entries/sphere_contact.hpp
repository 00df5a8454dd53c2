#pragma once
// What YADE's laws do with the forces of a contact.

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Adds `force` (N) to the second body and its opposite to the first, with their torques.
inline void addContactForce(yade::Scene& scene, const yade::Interaction& contact,
                            const yade::ScGeom& geom, const yade::Vector3r& force) {
  for (const auto& [id, sign] : {std::pair(contact.getId1(), -1.), {contact.getId2(), 1.}}) {
    const yade::Vector3r& place =
        scene.bodies->body[static_cast<std::size_t>(id)]->state->se3.position;
    const yade::Vector3r part = sign * force;
    scene.forces.addForce(id, part);
    scene.forces.addTorque(id, (geom.contactPoint - place).cross(part));
  }
}

}  // namespace yadefrag
