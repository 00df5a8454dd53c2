#include "loop/shape_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <typeinfo>

#include "loop/contact_law.hpp"

namespace yadefrag {

namespace {

using yade::Matrix3r, yade::Vector3r;

// YADE's radius of a plane, relative to that of the sphere, with the option `hertzian`.
constexpr double kHertzian = 1e8;

template <class Shape>
const Shape& shapeOf(const yade::Body& body) {
  return static_cast<const Shape&>(*body.shape);
}

// YADE from 2025.2 on has this option of a box's functor.
template <class Functor>
double boxRadius(const Functor& functor, double radius) {
  if constexpr (requires { functor.hertzian; })
    return functor.hertzian ? kHertzian * radius : radius;
  return radius;
}

}  // namespace

ShapeContacts::ShapeContacts(const yade::IGeomDispatcher& dispatcher, bool haveRotations) {
  const auto& all = dispatcher.functors;
  if (haveRotations) {
    facet_ = exactly<yade::Ig2_Facet_Sphere_ScGeom6D>(all);
    box_ = exactly<yade::Ig2_Box_Sphere_ScGeom6D>(all);
  } else {
    facet_ = exactly<yade::Ig2_Facet_Sphere_ScGeom>(all);
    wall_ = exactly<yade::Ig2_Wall_Sphere_ScGeom>(all);
    box_ = exactly<yade::Ig2_Box_Sphere_ScGeom>(all);
  }
  // YADE's functor may warn of its factor, and change it.
  if (facet_ && facet_->shrinkFactor != 0) facet_ = nullptr;
}

bool ShapeContacts::isShapeOf(const yade::IGeomFunctor* functor, const yade::Body& body) const {
  const yade::Shape& shape = *body.shape;
  if (functor == facet_) return typeid(shape) == typeid(yade::Facet);
  if (functor == wall_) return typeid(shape) == typeid(yade::Wall);
  return typeid(shape) == typeid(yade::Box);
}

ContactGeometry ShapeContacts::next(const yade::IGeomFunctor* functor, const yade::Body& body,
                                    const yade::ScGeom& last, const BodyRow& one,
                                    const BodyRow& sphere, const ImageShift& shift,
                                    double dt) const {
  const Touch touch = *find(functor, body, sphere, shift, true);
  ContactGeometry next;
  next.normal = loadThree(touch.normal.data()), next.point = loadThree(touch.point.data());
  next.depth = touch.depth;
  next.radius1 = touch.radius1, next.radius2 = sphere.radius();
  finishGeometry(loadThree(last.normal.data()), one, sphere, shift, dt, touch.avoidsRatcheting,
                 next);
  return next;
}

std::optional<ShapeContacts::Touch> ShapeContacts::find(const yade::IGeomFunctor* functor,
                                                        const yade::Body& body,
                                                        const BodyRow& sphere,
                                                        const ImageShift& shift,
                                                        bool isReal) const {
  Vector3r centre;
  storeThree(sphere.position() + shift.distance, centre.data());
  if (functor == facet_) return onFacet(body, centre, sphere.radius(), isReal);
  if (functor == wall_) return onWall(body, centre, sphere.radius(), isReal);
  return onBox(body, sphere, centre, isReal);
}

std::optional<ShapeContacts::Touch> ShapeContacts::onFacet(const yade::Body& body,
                                                           const Vector3r& centre, double radius,
                                                           bool isReal) const {
  const auto& facet = shapeOf<yade::Facet>(body);
  const Matrix3r axes = body.state->se3.orientation.toRotationMatrix();
  const Matrix3r toLocal = axes.transpose();
  const Vector3r local = toLocal * (centre - body.state->se3.position);
  Vector3r normal = facet.normal;
  double height = normal.dot(local);
  if (height < 0) normal = -normal, height = -height;
  if (height > radius && !isReal) return {};

  Vector3r inPlane = local - height * normal;
  int edge = 0;
  double distance = facet.ne[0].dot(inPlane);  // of that edge from the inscribed circle's centre
  for (int i = 1; i < 3; ++i) {
    const double other = facet.ne[i].dot(inPlane);
    if (distance < other) distance = other, edge = i;
  }
  Touch touch{};
  if (distance < facet.icr) {
    touch.depth = radius - height;
    normal.normalize();
  } else {
    // Nearest point of the edge, or one of its two corners.
    inPlane = inPlane + facet.ne[edge] * (facet.icr - distance);
    const int before = edge == 0 ? 2 : edge - 1, after = edge == 2 ? 0 : edge + 1;
    if (inPlane.dot(facet.ne[before]) > facet.icr) {
      inPlane = facet.vu[edge] * facet.vl[edge];
    } else if (inPlane.dot(facet.ne[after]) > facet.icr) {
      inPlane = facet.vu[after] * facet.vl[after];
    }
    normal = local - inPlane;
    const double size = normal.norm();
    normal /= size;
    touch.depth = radius - size;
  }
  if (!(touch.depth > 0) && !isReal) return {};
  touch.normal = axes * normal;
  touch.point = centre - (radius - .5 * touch.depth) * touch.normal;
  touch.radius1 = facet_->hertzian ? kHertzian * radius : 2 * radius;
  return touch;
}

std::optional<ShapeContacts::Touch> ShapeContacts::onWall(const yade::Body& body,
                                                          const Vector3r& centre, double radius,
                                                          bool isReal) const {
  const auto& wall = shapeOf<yade::Wall>(body);
  const double distance = centre[wall.axis] - body.state->se3.position[wall.axis];
  if (!isReal && std::abs(distance) > radius) return {};
  Touch touch{};
  touch.point = centre;
  touch.point[wall.axis] = body.state->se3.position[wall.axis];
  touch.normal = Vector3r::Zero();
  const bool isAbove = wall.sense == 0 ? distance > 0 : wall.sense == 1;
  touch.normal[wall.axis] = isAbove ? 1 : -1;
  touch.depth = -(std::abs(distance) - radius);
  touch.radius1 = wall_->hertzian ? kHertzian * radius : radius;
  touch.avoidsRatcheting = wall_->noRatch;
  return touch;
}

std::optional<ShapeContacts::Touch> ShapeContacts::onBox(const yade::Body& body,
                                                         const BodyRow& sphere,
                                                         const Vector3r& centre,
                                                         bool isReal) const {
  const Vector3r& half = shapeOf<yade::Box>(body).extents;
  const double radius = sphere.radius();
  const Matrix3r axes = body.state->se3.orientation.toRotationMatrix();
  const Matrix3r toLocal = axes.transpose();
  const Vector3r between = centre - body.state->se3.position;
  Vector3r nearest = toLocal * between;  // point of the box
  bool isInside = true;
  for (int i = 0; i < 3; ++i) {
    if (nearest[i] < -half[i]) nearest[i] = -half[i], isInside = false;
    if (nearest[i] > half[i]) nearest[i] = half[i], isInside = false;
  }
  Touch touch{};
  touch.radius1 = boxRadius(*box_, radius);
  if (isInside) {
    // Through the nearest side.
    int side = 0;
    double depth = half[0] - std::abs(nearest[0]);
    for (int i = 1; i < 3; ++i) {
      const double other = half[i] - std::abs(nearest[i]);
      if (other < depth) depth = other, side = i;
    }
    Vector3r outward = Vector3r::Zero();
    outward[side] = nearest[side] > 0 ? 1 : -1;
    Vector3r normal = axes * outward;
    normal.normalize();
    // Without the shift of the image, as YADE has it.
    Vector3r own;
    storeThree(sphere.position(), own.data());
    const Vector3r point1 = own + normal * depth, point2 = own - normal * radius;
    touch.normal = point1 - point2;
    touch.depth = touch.normal.norm();
    touch.normal.normalize();
    touch.point = .5 * (point1 + point2);
    touch.avoidsRatcheting = true;
    return touch;
  }
  const Vector3r onBox = axes * nearest;
  Vector3r toBox = onBox - between;
  touch.depth = radius - toBox.norm();
  if (-touch.depth > radius * (box_->interactionDetectionFactor - 1.) && !isReal) return {};
  toBox.normalize();
  touch.point = .5 * ((onBox + body.state->se3.position) + (centre + toBox * radius));
  touch.normal = -toBox;
  return touch;
}

}  // namespace yadefrag
