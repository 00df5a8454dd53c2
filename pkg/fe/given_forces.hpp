#pragma once
// Forces that FESolver adds to YADE's bodies: they remain until the next reset of forces, and there
// may be none before the next step.

#include <vector>

#include "abi/helpers.hpp"

namespace yadefrag {

class GivenForces {
 public:
  struct Given {
    yade::Body::id_t id;
    yade::Vector3r force, torque;  ///< N, N m
    double work;                   ///< J, on a boundary that has moved by its own velocity
  };

  /// Takes back the forces of the last step, unless they have been reset since.
  void begin(yade::Scene& scene) {
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
  void add(yade::Scene& scene, const Given& one) {
    scene.forces.addForce(one.id, one.force);
    scene.forces.addTorque(one.id, one.torque);
    all_.push_back(one);
  }
  /// Must be called after all forces and all new bodies of a step: YADE's reset deletes, and
  /// O.forces.f shows, only forces that have been synchronised since the last new body.
  /// NewtonIntegrator does that, too, if there is one.
  void end(yade::Scene& scene) {
    lastReset_ = lastReset(scene.forces);
    scene.forces.sync();
  }

  /// Forces of the last step, in the order of `add`: several for one body.
  [[nodiscard]] const std::vector<Given>& all() const { return all_; }

 private:
  std::vector<Given> all_;
  long lastReset_ = 0;  // step of the last reset when they were added
};

}  // namespace yadefrag
