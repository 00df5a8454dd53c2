#include "entries/segment_functors.hpp"

#include "entries/surface_segment.hpp"

namespace yadefrag {

using yade::Vector3r;

void Bo1_SurfaceSegment_Aabb::go(const yade::shared_ptr<yade::Shape>& shape,
                                 yade::shared_ptr<yade::Bound>& bound, const yade::Se3r& /*se3*/,
                                 const yade::Body* /*body*/) {
  const auto& segment = static_cast<const SurfaceSegment&>(*shape);
  if (!bound) bound.reset(new yade::Aabb);
  Vector3r corners[4] = {segment.start, segment.end, segment.start, segment.end};
  if (segment.isArc()) {
    corners[2] = .5 * (segment.start + segment.middle);
    corners[3] = .5 * (segment.middle + segment.end);
  }
  Vector3r low = corners[0], high = corners[0];
  for (Vector3r at : corners) {
    if (scene->isPeriodic) at = scene->cell->unshearPt(at);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  bound->min = low.array() - segment.halo;
  bound->max = high.array() + segment.halo;
}

bool Ig2_Sphere_SurfaceSegment_ScGeom::go(const yade::shared_ptr<yade::Shape>& sphere,
                                          const yade::shared_ptr<yade::Shape>& segment,
                                          const yade::State& state1, const yade::State& state2,
                                          const Vector3r& shift2, const bool& force,
                                          const yade::shared_ptr<yade::Interaction>& contact) {
  const double radius = static_cast<const yade::Sphere&>(*sphere).radius;
  const Vector3r centre = state1.se3.position - shift2;
  auto& piece = static_cast<SurfaceSegment&>(*segment);
  const auto touch = discContact(piece.piece(), {centre[0], centre[1]}, radius);
  // A pair is evaluated by one thread.
  const double depth = piece.depthForLaw(contact->getId1(), touch ? touch->penetration : 0);
  if (!touch) {
    if (!contact->isReal() && !force) return false;
    // Contacts without overlap are ended by the law, not here.
    if (!contact->geom) contact->geom.reset(new yade::ScGeom);
    static_cast<yade::ScGeom&>(*contact->geom).penetrationDepth = -radius;
    return true;
  }
  const bool isNew = !contact->geom;
  if (isNew) contact->geom.reset(new yade::ScGeom);
  auto& geom = static_cast<yade::ScGeom&>(*contact->geom);
  geom.radius1 = geom.radius2 = radius;
  geom.penetrationDepth = depth;
  const Vector3r normal(-touch->normal.x, -touch->normal.y, 0);
  // In the middle of the overlap, where laws for spheres expect it.
  geom.contactPoint = state1.se3.position + (radius - .5 * touch->penetration) * normal;
  geom.precompute(state1, state2, scene, contact, normal, isNew, shift2, false);
  return true;
}

bool Ig2_Sphere_SurfaceSegment_ScGeom::goReverse(
    const yade::shared_ptr<yade::Shape>& segment, const yade::shared_ptr<yade::Shape>& sphere,
    const yade::State& state1, const yade::State& state2, const Vector3r& shift2, const bool& force,
    const yade::shared_ptr<yade::Interaction>& contact) {
  contact->swapOrder();
  return go(sphere, segment, state2, state1, -shift2, force, contact);
}

}  // namespace yadefrag
