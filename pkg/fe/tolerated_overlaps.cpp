#include "fe/tolerated_overlaps.hpp"

#include <algorithm>

#include "fe/sphere_contact.hpp"
#include "fe/surface_segment.hpp"

namespace yadefrag {
namespace {

using yade::Vector3r;

bool isNew(const yade::Interaction& contact, const yade::Scene& scene) {
  return contact.iterMadeReal == scene.iter;
}

int componentOf(const yade::Body& piece) {
  return static_cast<const SurfaceSegment&>(*piece.shape).component;
}

bool isHeldSince(const yade::Body& sphere, int component, const yade::Scene& scene,
                 const EntryBodies& bodies) {
  const auto isOlder = [&](const auto& with) {
    const auto& [other, contact] = with;
    const EntryId entry = bodies.entryOf(other);
    return contact->isReal() && !isNew(*contact, scene) && entry != EntryId::none() &&
           bodies.hasBody(entry) && componentOf(bodies.body(entry)) == component;
  };
  return std::any_of(sphere.intrs.begin(), sphere.intrs.end(), isOlder);
}

}  // namespace

void ToleratedOverlaps::findNew(const yade::Scene& scene, const EntryBodies& bodies) {
  energyOfNew_ = 0;
  for (std::size_t e = 0; e < bodies.ids().size(); ++e) {
    if (!bodies.hasBody(EntryId(e))) continue;
    const yade::Body& piece = bodies.body(EntryId(e));
    for (const auto& [id, contact] : piece.intrs) {
      if (!contact->isReal() || !isNew(*contact, scene)) continue;
      const auto& sphere = scene.bodies->body[static_cast<std::size_t>(id)];
      const auto* geom = dynamic_cast<const yade::ScGeom*>(contact->geom.get());
      const auto* phys = dynamic_cast<const yade::NormShearPhys*>(contact->phys.get());
      if (!sphere || !geom || !phys || !isHeldSince(*sphere, componentOf(piece), scene, bodies))
        continue;
      const double depth = geom->penetrationDepth;
      const double travel = (sphere->state->vel - piece.state->vel).norm() * scene.dt;
      // Factor 2, since a step of another length may have brought the two together.
      if (!(depth > 2 * travel)) continue;
      overlaps_.push_back({id, bodies.ids()[e], depth, true});
      energyOfNew_ += .5 * phys->kn * depth * depth;
    }
  }
}

bool ToleratedOverlaps::reduceForces(yade::Scene& scene) {
  const auto kept = std::remove_if(overlaps_.begin(), overlaps_.end(),
                                   [&](Overlap& one) { return !reduce(scene, one); });
  overlaps_.erase(kept, overlaps_.end());
  for (Overlap& one : overlaps_) one.isNew = false;
  return !overlaps_.empty();
}

/// Returns false if the contact has ended.
bool ToleratedOverlaps::reduce(yade::Scene& scene, Overlap& overlap) {
  const auto& contact = scene.interactions->find(overlap.sphere, overlap.piece);
  if (!contact || !contact->isReal() || (!overlap.isNew && isNew(*contact, scene))) return false;
  const auto* geom = dynamic_cast<const yade::ScGeom*>(contact->geom.get());
  auto* phys = dynamic_cast<yade::NormShearPhys*>(contact->phys.get());
  if (!geom || !phys || !(geom->penetrationDepth > 0)) return false;
  overlap.depth = std::min(overlap.depth, geom->penetrationDepth);
  const Vector3r normal = -overlap.depth / geom->penetrationDepth * phys->normalForce;
  phys->normalForce += normal;
  const double friction = smallerFriction(scene, overlap.sphere, overlap.piece);
  const double shear = phys->shearForce.norm(), most = friction * phys->normalForce.norm();
  const Vector3r change =
      shear > most ? Vector3r((most / shear - 1) * phys->shearForce) : Vector3r(Vector3r::Zero());
  phys->shearForce += change;
  addContactForce(scene, *contact, *geom, normal + change);
  return true;
}

void ToleratedOverlaps::forgetNew() {
  std::erase_if(overlaps_, [](const Overlap& one) { return one.isNew; });
}

}  // namespace yadefrag
