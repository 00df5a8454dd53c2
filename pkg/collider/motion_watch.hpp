#pragma once
// Checks whether the bounds of the last search are still valid; if not, a search is due.

#include <vector>

#include "abi/yade.hpp"
#include "collider/body_boxes.hpp"

namespace yadefrag {

/// YADE's integrator checks the positions if it moves every body. Otherwise (no integrator, a dead
/// one, one with a mask) they are checked here. Always checked here: rotating bodies, a deforming
/// cell, and nodes without a bound that grid connections and PFacets follow; the integrator does
/// not check these.
class MotionWatch {
 public:
  /// Starts the check for bounds that were just updated. `cellSpan`: largest distance of two
  /// neighbours in cells, per axis.
  void start(const yade::Scene& scene, const BodyBoxes& boxes, double cellSlack,
             const yade::Vector3r& cellSpan);

  [[nodiscard]] bool boundsBroken(const yade::Scene& scene) const;

  /// The integrator that moves the scene's bodies; null if there is none or it is dead.
  static yade::shared_ptr<yade::NewtonIntegrator> findIntegrator(const yade::Scene& scene);

  /// Displacement record of the integrator: 0 if it has moved no body, below 1 within bounds or if
  /// yade.mpy has searched since, otherwise outside.
  static double fastestBody(const yade::Scene& scene, const yade::NewtonIntegrator& newton);

 private:
  [[nodiscard]] bool cellMoved(const yade::Scene& scene) const;
  [[nodiscard]] bool someTurnedOut(const yade::Scene& scene) const;
  static bool someMovedOut(const yade::Scene& scene);
  [[nodiscard]] bool someNodeMovedOut(const yade::Scene& scene) const;

  struct Node {
    yade::Body::id_t id;
    yade::Vector3r position;
  };
  std::vector<Node> nodes_;
  double nodeSweep_ = 0;  // m
  std::vector<Turning> turning_;
  bool isSplit_ = false;
  double cellSlack_ = 0;
  yade::Vector3r cellSpan_ = yade::Vector3r::Zero();
  yade::Matrix3r cellBefore_ = yade::Matrix3r::Zero();
};

}  // namespace yadefrag
