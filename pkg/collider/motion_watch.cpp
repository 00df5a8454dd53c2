#include "collider/search_collider.hpp"

#include <algorithm>
#include <cmath>

namespace yadefrag {

using yade::NewtonIntegrator;
using yade::Scene;

void MotionWatch::start(const Scene& scene, const BodyBoxes& boxes, double cellSlack,
                        const yade::Vector3r& cellSpan) {
  turning_ = boxes.turning();
  isSplit_ = boxes.isSplit();
  cellSlack_ = cellSlack;
  cellSpan_ = cellSpan;
  if (scene.isPeriodic) cellBefore_ = scene.cell->hSize;
  nodes_.clear();
  nodeSweep_ = boxes.followerSweep();
  if (!std::isfinite(nodeSweep_)) return;
  for (const auto& body : scene.bodies->body)
    if (body && !(body->bound && body->isBounded()))
      nodes_.push_back({body->id, body->state->se3.position});
}

/// In a process of yade.mpy without bodies of its own the integrator always reports 0. (YADE makes
/// all processes search at every step then.)
bool MotionWatch::boundsBroken(const Scene& scene) const {
  const auto newton = findIntegrator(scene);
  const bool isWatching = newton && newton->mask <= 0;
  const double fastest = isWatching ? fastestBody(scene, *newton) : 0;
  if (fastest >= 1 || (fastest == 0 && isWatching && !isSplit_)) return true;
  if (fastest == 0 && someMovedOut(scene)) return true;
  return someTurnedOut(scene) || someNodeMovedOut(scene) || (scene.isPeriodic && cellMoved(scene));
}

yade::shared_ptr<NewtonIntegrator> MotionWatch::findIntegrator(const Scene& scene) {
  for (const auto& engine : scene.engines) {
    auto newton = boost::dynamic_pointer_cast<NewtonIntegrator>(engine);
    if (newton && !newton->dead) return newton;
  }
  return {};
}

/// In a periodic scene `maxVelocitySq` also contains the cell's speed in m/s, so that the next
/// search would depend on the unit of length: the cell is checked here, and the values of the
/// threads are used. In both cases a smaller `maxVelocitySq` comes from yade.mpy, which sets it
/// after a search of all processes: a search of one alone would move its bounds away from those of
/// the others.
double MotionWatch::fastestBody(const Scene& scene, const NewtonIntegrator& newton) {
  const auto& byThread = newton.threadMaxVelocitySq;
  if (!scene.isPeriodic) return newton.maxVelocitySq;
  if (byThread.empty()) return 0;
  return std::min(*std::max_element(byThread.begin(), byThread.end()), newton.maxVelocitySq);
}

bool MotionWatch::someMovedOut(const Scene& scene) {
  for (const auto& body : scene.bodies->body) {
    if (!body || !body->bound || !body->isBounded()) continue;
    const yade::Vector3r moved = body->state->se3.position - body->bound->refPos;
    const double most = moved.cwiseAbs().maxCoeff();
    if (most > 0 && !(most < body->bound->sweepLength)) return true;
  }
  return false;
}

/// The nodes that a shape follows are unknown here: any body without a bound may be one.
bool MotionWatch::someNodeMovedOut(const Scene& scene) const {
  const auto& bodies = scene.bodies->body;
  return std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& was) {
    const auto id = static_cast<std::size_t>(was.id);
    if (id >= bodies.size() || !bodies[id]) return false;
    const yade::Vector3r moved = bodies[id]->state->se3.position - was.position;
    const double most = moved.cwiseAbs().maxCoeff();
    return most > 0 && !(most < nodeSweep_);
  });
}

bool MotionWatch::someTurnedOut(const Scene& scene) const {
  const auto& bodies = scene.bodies->body;
  for (const Turning& was : turning_) {
    const auto id = static_cast<std::size_t>(was.id);
    if (id >= bodies.size() || !bodies[id] || !bodies[id]->bound) continue;
    const yade::State& state = *bodies[id]->state;
    const double turned = was.turnedBy(state.se3.orientation);
    if (turned == 0) continue;
    const double moved = (state.se3.position - bodies[id]->bound->refPos).cwiseAbs().maxCoeff();
    if (!(moved + turned < bodies[id]->bound->sweepLength)) return true;
  }
  return false;
}

/// Two neighbours that are k cells apart approach each other by up to ‖ΔH k‖ when the cell changes
/// from H to H + ΔH, in addition to their own motion.
bool MotionWatch::cellMoved(const Scene& scene) const {
  const yade::Matrix3r change = (scene.cell->hSize - cellBefore_).cwiseAbs();
  if (change.isZero(0)) return false;
  return !((change * cellSpan_).maxCoeff() < 2 * cellSlack_);
}

}  // namespace yadefrag
