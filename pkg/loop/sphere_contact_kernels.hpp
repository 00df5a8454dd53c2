#pragma once
// Geometry and force of a contact of two spheres: the formulas of YADE's Ig2_Sphere_Sphere_ScGeom
// and Law2_ScGeom_FrictPhys_CundallStrack, in the order of their operations, so that every bit is
// the same. They are inline: YADE's are reached through three virtual calls and copies of shared
// pointers.

#include <algorithm>
#include <cmath>

#include "loop/exposed.hpp"

namespace yadefrag {

/// Force (N) on the first body of a contact, the opposite of that on the second, and the torques (N
/// m).
struct ContactForce {
  yade::Vector3r force;
  yade::Vector3r torque1;
  yade::Vector3r torque2;
};

/// What the geometry of a contact needs of a sphere: m, m/s, rad/s.
struct SphereMotion {
  yade::Vector3r position;
  yade::Vector3r velocity;
  yade::Vector3r spin;
  double radius;
};

/// The geometry after a step of `dt` (s), from that of the step before; not periodic.
[[gnu::always_inline]] inline void updateGeometry(yade::ScGeom& geom, const SphereMotion& one,
                                                  const SphereMotion& two, double dt,
                                                  bool avoidsRatcheting) {
  using yade::Vector3r;
  Vector3r normal = two.position - one.position;
  const double distance = normal.norm();
  normal /= distance;
  const double depth = one.radius + two.radius - distance;
  geom.contactPoint = one.position + (one.radius - .5 * depth) * normal;
  geom.penetrationDepth = depth;
  geom.refR1 = one.radius;
  geom.refR2 = two.radius;

  geom.*exposed(OrthonormalAxis{}) = geom.normal.cross(normal);
  const double angle = dt * .5 * geom.normal.dot(one.spin + two.spin);
  geom.*exposed(TwistAxis{}) = angle * geom.normal;
  geom.normal = normal;

  Vector3r velocity;
  if (avoidsRatcheting) {
    const double alpha = (one.radius + two.radius) / (one.radius + two.radius - depth);
    velocity = (two.velocity - one.velocity) * alpha + two.spin.cross(-two.radius * normal) -
               one.spin.cross(one.radius * normal);
  } else {
    const Vector3r arm1 = geom.contactPoint - one.position;
    const Vector3r arm2 = geom.contactPoint - two.position;
    velocity = (two.velocity + two.spin.cross(arm2)) - (one.velocity + one.spin.cross(arm1));
  }
  velocity = velocity - normal.dot(velocity) * normal;
  geom.shearInc = velocity * dt;
}

/// Elastic normal force and shear force limited by friction. False: the bodies are apart, and
/// nothing was changed. Energies are not counted.
[[gnu::always_inline]] inline bool updateForces(const yade::ScGeom& geom, yade::FrictPhys& phys,
                                                bool isKeptApart) {
  using yade::Vector3r;
  if (geom.penetrationDepth < 0) {
    if (!isKeptApart) return false;
    phys.shearForce = Vector3r::Zero();
    phys.normalForce = Vector3r::Zero();
  }
  phys.normalForce = phys.kn * std::max(geom.penetrationDepth, 0.) * geom.normal;
  Vector3r shear = phys.shearForce;
  shear -= shear.cross(geom.*exposed(OrthonormalAxis{}));
  shear -= shear.cross(geom.*exposed(TwistAxis{}));
  shear -= phys.ks * geom.shearInc;
  const double tangent = phys.tangensOfFrictionAngle;
  const double limit = phys.normalForce.squaredNorm() * (tangent * tangent);
  if (shear.squaredNorm() > limit) {
    const double ratio = std::sqrt(limit) / shear.norm();
    shear *= ratio;
  }
  phys.shearForce = shear;
  return true;
}

/// `arePointsOfSpheres`: arms from the radii; otherwise from the contact point. `place2` is the
/// position of the image of the second body that is in contact.
[[gnu::always_inline]] inline ContactForce contactForce(const yade::ScGeom& geom,
                                                        const yade::FrictPhys& phys,
                                                        bool arePointsOfSpheres,
                                                        const yade::Vector3r& place1,
                                                        const yade::Vector3r& place2) {
  using yade::Vector3r;
  const Vector3r force = -phys.normalForce - phys.shearForce;
  if (arePointsOfSpheres) {
    const Vector3r moment = geom.normal.cross(force);
    return {force, (geom.refR1 - .5 * geom.penetrationDepth) * moment,
            (geom.refR2 - .5 * geom.penetrationDepth) * moment};
  }
  return {force, (geom.contactPoint - place1).cross(force),
          -(geom.contactPoint - place2).cross(force)};
}

}  // namespace yadefrag
