#pragma once
// Geometry of a contact of two spheres, and what laws have in common: the formulas of YADE's
// Ig2_Sphere_Sphere_ScGeom in the order of their operations, so that every bit is the same. They
// are inline, as the laws are (`contact_law.hpp`): YADE's are reached through three virtual calls
// and copies of shared pointers.

#include <cmath>

#include "core/four_lanes.hpp"
#include "yade/exposed.hpp"

namespace yadefrag {

/// Force (N) on the first body of a contact, the opposite of that on the second, and the torques (N
/// m).
struct ContactForce {
  FourLanes force;
  FourLanes torque1;
  FourLanes torque2;
};

/// A body at the begin of the step, and the sums of its forces, in two cache lines:
///
///   | position (m) | radius (m) | velocity (m/s) | spin (rad/s) | force (N) | torque (N m) |
///     0              3            4                7              10          13
///
/// A load of four lanes from a vector also reads the next value, which is not used.
struct alignas(64) BodyRow {
  double values[16];

  [[gnu::always_inline]] [[nodiscard]] FourLanes position() const { return loadFour(values); }
  [[nodiscard]] double radius() const { return values[3]; }
  [[gnu::always_inline]] [[nodiscard]] FourLanes velocity() const { return loadFour(values + 4); }
  [[gnu::always_inline]] [[nodiscard]] FourLanes spin() const { return loadFour(values + 7); }
  [[gnu::always_inline]] [[nodiscard]] FourLanes force() const { return loadFour(values + 10); }
  [[gnu::always_inline]] [[nodiscard]] FourLanes torque() const { return loadThree(values + 13); }
  [[gnu::always_inline]] void setMotion(const yade::State& state, double radius) {
    storeThree(loadThree(state.se3.position.data()), values);
    values[3] = radius;
    storeThree(loadThree(state.vel.data()), values + 4);
    storeThree(loadThree(state.angVel.data()), values + 7);
  }
  [[gnu::always_inline]] void setSums(const FourLanes& force, const FourLanes& torque) {
    storeThree(force, values + 10), storeThree(torque, values + 13);
  }
};

/// What laws with damping need of a body besides its row.
struct BodyMass {
  double mass;  // kg
  bool isDynamic;
};

/// Distance (m) from a body to its image that is in contact, and the difference of their velocities
/// (m/s).
struct ImageShift {
  FourLanes distance;
  FourLanes velocity;
};

/// The geometry of a contact, in registers: what the law uses after it was computed.
struct ContactGeometry {
  FourLanes normal;
  FourLanes point;
  FourLanes turn;      // change of the normal
  FourLanes twist;     // rotation about the normal
  FourLanes shearing;  // m, in this step
  double depth;
  double radius1, radius2;

  [[gnu::always_inline]] static ContactGeometry read(const yade::ScGeom& geom) {
    return {loadThree(geom.normal.data()),
            loadThree(geom.contactPoint.data()),
            loadThree((geom.*exposed(OrthonormalAxis{})).data()),
            loadThree((geom.*exposed(TwistAxis{})).data()),
            loadThree(geom.shearInc.data()),
            geom.penetrationDepth,
            geom.refR1,
            geom.refR2};
  }
  [[gnu::always_inline]] void write(yade::ScGeom& geom) const {
    storeThree(normal, geom.normal.data());
    storeThree(point, geom.contactPoint.data());
    storeThree(turn, (geom.*exposed(OrthonormalAxis{})).data());
    storeThree(twist, (geom.*exposed(TwistAxis{})).data());
    storeThree(shearing, geom.shearInc.data());
    geom.penetrationDepth = depth;
    geom.refR1 = radius1, geom.refR2 = radius2;
  }
};

/// Velocity (m/s) of the second body relative to the first one at a point of both.
[[gnu::always_inline]] inline FourLanes velocityAt(const FourLanes& point, const BodyRow& one,
                                                   const BodyRow& two, const ImageShift& shift) {
  const FourLanes arm1 = point - one.position();
  const FourLanes arm2 = point - (two.position() + shift.distance);
  return (two.velocity() + cross(two.spin(), arm2)) - (one.velocity() + cross(one.spin(), arm1)) +
         shift.velocity;
}

/// YADE's ScGeom::precompute: what follows, in a step of `dt` (s), from normal, point, depth and
/// radii, and from the normal of the step before.
[[gnu::always_inline]] inline void finishGeometry(const FourLanes& lastNormal, const BodyRow& one,
                                                  const BodyRow& two, const ImageShift& shift,
                                                  double dt, bool avoidsRatcheting,
                                                  ContactGeometry& next) {
  const FourLanes spin1 = one.spin(), spin2 = two.spin();
  next.turn = cross(lastNormal, next.normal);
  next.twist = dt * .5 * dot(lastNormal, spin1 + spin2) * lastNormal;

  FourLanes velocity;
  if (avoidsRatcheting) {
    const double radii = next.radius1 + next.radius2;
    const double alpha = radii / (radii - next.depth);
    velocity = (two.velocity() - one.velocity()) * alpha +
               cross(spin2, -next.radius2 * next.normal) -
               cross(spin1, next.radius1 * next.normal) + alpha * shift.velocity;
  } else {
    velocity = velocityAt(next.point, one, two, shift);
  }
  velocity = velocity - dot(next.normal, velocity) * next.normal;
  next.shearing = velocity * dt;
}

/// The geometry of two spheres after a step of `dt` (s), from the normal of the step before.
[[gnu::always_inline]] inline ContactGeometry nextGeometry(const FourLanes& lastNormal,
                                                           const BodyRow& one, const BodyRow& two,
                                                           const ImageShift& shift, double dt,
                                                           bool avoidsRatcheting) {
  const FourLanes position1 = one.position(), position2 = two.position() + shift.distance;
  ContactGeometry next;
  next.radius1 = one.radius(), next.radius2 = two.radius();
  const FourLanes between = position2 - position1;
  const double distance = norm(between);
  next.normal = between / distance;
  next.depth = next.radius1 + next.radius2 - distance;
  next.point = position1 + (next.radius1 - .5 * next.depth) * next.normal;
  finishGeometry(lastNormal, one, two, shift, dt, avoidsRatcheting, next);
  return next;
}

/// Orientations (x, y, z, w) of the bodies of a contact.
struct Orientations {
  FourLanes one, two;
};

/// YADE's ScGeom6D::precomputeRotations, of a contact that has begun before: the rotation of the
/// bodies relative to each other since then.
[[gnu::always_inline]] inline void updateRotations(yade::ScGeom6D& geom, const FourLanes& normal,
                                                   const Orientations& now, bool hasCreep) {
  const FourLanes conjugate{-1, -1, -1, 1};
  const auto begin1 = loadFour(geom.initialOrientation1.coeffs().data()),
             begin2 = loadFour(geom.initialOrientation2.coeffs().data());
  FourLanes turn = quaternionProduct(quaternionProduct(now.one, conjugate * begin1),
                                     quaternionProduct(begin2, conjugate * now.two));
  if (const double square = squaredNormOfFour(turn); square > 0) turn /= std::sqrt(square);
  if (hasCreep) turn = quaternionProduct(turn, loadFour(geom.twistCreep.coeffs().data()));
  const Eigen::AngleAxis<double> rotation(
      Eigen::Quaternion<double>(turn[3], turn[0], turn[1], turn[2]));
  const double size = std::isnan(rotation.angle()) ? 0 : rotation.angle();
  const double angle = size > M_PI ? size - 2 * M_PI : size;
  const FourLanes axis = loadThree(rotation.axis().data());
  geom.twist = angle * dot(axis, normal);
  storeThree(angle * axis - geom.twist * normal, geom.bending.data());
}

/// A vector in the plane of the contact, turned with it.
[[gnu::always_inline]] inline FourLanes turned(const FourLanes& vector,
                                               const ContactGeometry& geometry) {
  const FourLanes first = vector - cross(vector, geometry.turn);
  return first - cross(first, geometry.twist);
}

/// `arePointsOfSpheres`: arms from the radii; otherwise from the contact point. `place2` is the
/// position of the image of the second body that is in contact.
[[gnu::always_inline]] inline ContactForce contactForce(const ContactGeometry& geometry,
                                                        const FourLanes& forceOnSecond,
                                                        bool arePointsOfSpheres,
                                                        const FourLanes& place1,
                                                        const FourLanes& place2) {
  const FourLanes force = -forceOnSecond;
  if (arePointsOfSpheres) {
    const FourLanes moment = cross(geometry.normal, force);
    return {force, (geometry.radius1 - .5 * geometry.depth) * moment,
            (geometry.radius2 - .5 * geometry.depth) * moment};
  }
  return {force, cross(geometry.point - place1, force), -cross(geometry.point - place2, force)};
}

}  // namespace yadefrag
