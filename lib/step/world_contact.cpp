// World: contact; data of the search and of the correction, and energies.

#include "core/tolerances/contact.hpp"
#include "core/tolerances/step.hpp"
#include "step/world.hpp"

namespace yadefrag {

void World::measureFinest() { finest_ = shortestSegment(model, surfaces, model.nodes.reference); }

/// A single body that cannot touch itself needs neither search nor candidates.
bool World::canTouch() const {
  const std::vector<ComponentId>& owners = surfaces.component;
  if (owners.empty()) return false;
  return model.components[owners.front().value].selfContact || severalBodies_;
}

HaloWatch::Scene World::searchScene() {
  return {model,
          surfaces,
          contactSettings,
          finest_,
          canTouch(),
          hasRigid(),
          !fracture.cohesion.edge.empty(),
          threads,
          timesIfRequested(),
          dynamics_,
          contact};
}

void World::correctContact(const StepLength& length) {
  const double most = search.largestMove();
  const ContactStep now{length,
                        dynamicsSettings.drag(length),
                        most,
                        finest_,
                        dynamics_.previousPosition(),
                        threads,
                        rigidMasses,
                        contactSettings.constants,
                        timesIfRequested(),
                        fracture.cohesion.isPulling() ? &fracture.cohesion : nullptr};
  undo_.hasCorrected = true;
  contact.correct(model, surfaces, now);
  for (const RigidMasses::Member& member : rigidMasses.members)
    dynamics_.setHeld(member.node, model.nodes.velocity[member.node.value]);
  search.addCorrection(contact.largestCorrection());
}

void World::countContactWork(const StepLength& length) {
  const StageTimer timer(timesIfRequested(), &StageTimes::correction);
  const std::span<const Vec2> former = dynamics_.previousVelocity();
  for (const ContactRow& row : contact.rows()) {
    const Vec2 mean = .5 * (relative(row, former) + relative(row, model.nodes.velocity));
    ledger.contact -= row.normalForce * dot(mean, row.normal) * length.velocity;
    ledger.friction -= row.tangentForce * dot(mean, row.tangent()) * length.velocity;
  }
}

}  // namespace yadefrag
