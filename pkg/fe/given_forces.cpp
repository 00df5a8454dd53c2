#include "fe/given_forces.hpp"

#include "abi/lookup.hpp"

namespace yadefrag {

void GivenForces::begin(yade::Scene& scene) {
  if (all_.empty()) return;
  if (lastReset(scene.forces) == lastReset_) {
    for (const Given& one : all_) {
      scene.forces.addForce(one.id, -one.force);
      scene.forces.addTorque(one.id, -one.torque);
    }
    scene.forces.sync();
  }
  all_.clear();
}

void GivenForces::add(yade::Scene& scene, const Given& one) {
  scene.forces.addForce(one.id, one.force);
  scene.forces.addTorque(one.id, one.torque);
  all_.push_back(one);
}

void GivenForces::end(yade::Scene& scene) {
  lastReset_ = lastReset(scene.forces);
  scene.forces.sync();
}

}  // namespace yadefrag
