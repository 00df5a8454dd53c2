#include "materials/surface_segment.hpp"

#include <algorithm>

namespace yadefrag {

using yade::Vector3r;

SurfaceSegment::Changed* SurfaceSegment::changedBy(yade::Body::id_t sphere) {
  const auto found = std::ranges::find(changed, sphere, &Changed::sphere);
  return found == changed.end() ? nullptr : &*found;
}

void SurfaceSegment::setChanged(const Changed& one) {
  std::erase_if(changed, [&](const Changed& other) { return other.sphere == one.sphere; });
  if (one.share != 1 || one.tolerated != 0) changed.push_back(one);
}

double SurfaceSegment::depthForLaw(yade::Body::id_t sphere, double depth) {
  if (changed.empty()) return depth;
  Changed* const one = changedBy(sphere);
  if (!one) return depth;
  one->tolerated = std::min(one->tolerated, depth);
  return one->share * (depth - one->tolerated);
}

void SurfaceSegment::archiveMore(AnyArchive& archive) {
  archive.rows("changedIds", "changedContacts", changed,
               "of a SurfaceSegment is damaged (its contacts with spheres are invalid)",
               [](Changed& one, const auto& each) {
                 each(one.sphere), each(one.share), each(one.tolerated);
               });
}

Attributes SurfaceSegment::attributes() {
  using C = SurfaceSegment;
  return attributeList(
      attribute("start", &C::start, "Begin of the piece (m)."),
      attribute("end", &C::end, "End of the piece (m)."),
      attribute("middle", &C::middle,
                "Of an arc: its central node (m), at which the tangents of its two ends meet."),
      attribute("before", &C::before,
                "Direction (unit vector) of the previous piece at `start`; zero: "
                "there is none, `start` is a free end."),
      attribute("after", &C::after,
                "Direction (unit vector) of the next piece at `end`; zero: there is none."),
      attribute("kind", &C::kind,
                "0: a segment between two nodes, 1 and 2: its first and second half, 3: an arc "
                "around a node."),
      attribute(
          "halo", &C::halo,
          "Length (m) by which the bound is larger than the piece, on every side: the distance "
          "that the piece may move before the next search."),
      attribute("entry", &C::entry, "Number of the surface entry in its FESolver; -1: none."),
      attribute("component", &C::component, "Number of the finite-element body; -1: none."),
      attribute("selfContact", &C::selfContact,
                "True if this piece may touch other pieces of its own body."));
}

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
