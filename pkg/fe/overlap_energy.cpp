#include "fe/overlap_energy.hpp"

namespace yadefrag {
namespace {

bool isNew(const yade::Interaction& contact, const yade::Scene& scene) {
  return contact.iterMadeReal == scene.iter;
}

bool isHeldSince(const yade::Body& sphere, const yade::Scene& scene, const EntryBodies& bodies) {
  for (const auto& [other, contact] : sphere.intrs)
    if (contact->isReal() && !isNew(*contact, scene) && bodies.entryOf(other) != EntryId::none())
      return true;
  return false;
}

/// (J)
double springEnergy(const yade::Interaction& contact, double travel) {
  const auto* geom = dynamic_cast<const yade::ScGeom*>(contact.geom.get());
  const auto* phys = dynamic_cast<const yade::NormShearPhys*>(contact.phys.get());
  // Factor 2, since a step of another length may have brought the two together.
  if (!geom || !phys || !(geom->penetrationDepth > 2 * travel)) return 0;
  return .5 * phys->kn * geom->penetrationDepth * geom->penetrationDepth;
}

}  // namespace

double initialOverlapEnergy(const yade::Scene& scene, const EntryBodies& bodies) {
  double sum = 0;
  for (std::size_t e = 0; e < bodies.ids().size(); ++e) {
    if (!bodies.hasBody(EntryId(e))) continue;
    const yade::Body& piece = bodies.body(EntryId(e));
    for (const auto& [id, contact] : piece.intrs) {
      if (!contact->isReal() || !isNew(*contact, scene)) continue;
      const auto& sphere = scene.bodies->body[static_cast<std::size_t>(id)];
      if (!sphere || !isHeldSince(*sphere, scene, bodies)) continue;
      const double travel = (sphere->state->vel - piece.state->vel).norm() * scene.dt;
      sum += springEnergy(*contact, travel);
    }
  }
  return sum;
}

}  // namespace yadefrag
