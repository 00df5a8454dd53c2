#include "integrator/curve_integrator.hpp"

#include <omp.h>

#include <cstddef>

#include "abi/request.hpp"
#include "core/parallel.hpp"

namespace yadefrag {

namespace {

// Bodies between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 8;

/// What `move` uses of a body, then of its state and bound.
void requestAhead(const std::vector<yade::shared_ptr<yade::Body>>& bodies, std::size_t index) {
  using yade::Body, yade::Bound, yade::State;
  if (index + 2 * kAhead < bodies.size()) {
    request(bodies[index + 2 * kAhead].get(), offsetof(Body, id),
            offsetof(Body, clumpId) + sizeof(Body::id_t));
  }
  if (index + kAhead >= bodies.size()) return;
  if (const Body* const body = bodies[index + kAhead].get()) {
    request(body->state.get(), offsetof(State, se3), sizeof(State));
    request(body->bound.get(), offsetof(Bound, refPos),
            offsetof(Bound, sweepLength) + sizeof(double));
  }
}

}  // namespace

MotionStep MotionIntegrator::motionStep() const {
  const yade::Cell& cell = *scene->cell;
  MotionStep step;
  step.dt = scene->dt;
  step.damping = damping;
  step.gravity = gravity;
  step.isGravityDamped = dampGravity;
  step.scalesDensity = densityScaling;
  step.isPeriodic = scene->isPeriodic;
  step.homoDeform = cell.homoDeform;
  step.prevVelGrad = prevVelGrad;
  const bool isChanged = cell.velGradChanged || cell.nextVelGrad != yade::Matrix3r::Zero();
  step.velGradChange = (isChanged ? cell.nextVelGrad : cell.velGrad) - prevVelGrad;
  const yade::Matrix3r turn = .5 * (step.velGradChange - step.velGradChange.transpose());
  step.spinChange = yade::Vector3r(-turn(1, 2), turn(0, 2), -turn(0, 1));
  return step;
}

bool MotionIntegrator::isOurs(const yade::Body& body) const {
  constexpr unsigned kRotations = yade::State::DOF_RX | yade::State::DOF_RY | yade::State::DOF_RZ;
  if (!body.isStandalone()) return false;
  const bool isAspherical = (body.flags & yade::Body::FLAG_ASPHERICAL) != 0;
  return !(isAspherical && exactAsphericalRot && (body.state->blockedDOFs & kRotations) == 0);
}

// YADE's NewtonIntegrator::action, for one body.
[[gnu::flatten]] void MotionIntegrator::move(const MotionStep& step, yade::Body& body,
                                             Part& part) const {
  if (body.isClumpMember()) return;
  if (mask > 0 && (body.groupMask & mask) == 0) return;
#ifdef YADE_MPI
  if (scene->subdomain != body.subdomain || body.getIsSubdomain() || body.getIsFluidDomainBbox()) {
    return;
  }
#endif
  if (!isOurs(body)) {
    part.others.push_back(body.id);
    return;
  }
  yade::State& state = *body.state;
  changeVelocity(step, scene->forces.getForce(body.id), scene->forces.getTorque(body.id), state);
  changePosition(step, state);
  ++part.moved;
  if (body.bound && isBeyondBound(*body.bound, state)) part.isAnyBeyond = true;
}

void MotionIntegrator::action() {
  fastBodies = 0;
  if (scene->trackEnergy) return yade::NewtonIntegrator::action();
  scene->forces.sync();
  memory_.endStep(*scene);
  const auto& bodies = scene->bodies->body;
  const MotionStep step = motionStep();
  const int most = omp_get_max_threads();
  parts_.assign(static_cast<std::size_t>(most), {});
  forEachPart(bodies.size(), most, [&](std::size_t begin, std::size_t end, int number) {
    Part part;
    for (std::size_t index = begin; index < end; ++index) {
      requestAhead(bodies, index);
      if (bodies[index]) move(step, *bodies[index], part);
    }
    parts_[static_cast<std::size_t>(number)] = part;
  });
  std::vector<yade::Body::id_t> others;
  bool isAnyBeyond = false;
  for (const Part& part : parts_) {
    others.insert(others.end(), part.others.begin(), part.others.end());
    fastBodies += part.moved;
    isAnyBeyond = isAnyBeyond || part.isAnyBeyond;
  }
  moveOthers(others);
  if (fastBodies == 0) return;
  // What NewtonIntegrator tells the collider: LebesgueCollider reads it by threads.
  const double told = isAnyBeyond ? 2 : .5;
  maxVelocitySq = std::max(maxVelocitySq, told);
  threadMaxVelocitySq.at(0) = std::max(threadMaxVelocitySq.at(0), told);
}

// Also what is done once in a step: changes of the cell's velocity gradient, warnings.
void MotionIntegrator::moveOthers(std::vector<yade::Body::id_t>& others) {
  yade::BodyContainer& bodies = *scene->bodies;
  const bool isDirty = bodies.dirty, isEnabled = bodies.enableRedirection,
             isUsed = bodies.useRedirection;
  const auto choose = [&](bool dirty, bool enabled, bool used) {
    bodies.realBodies.swap(others);
    bodies.dirty = dirty, bodies.enableRedirection = enabled, bodies.useRedirection = used;
  };
  // The list that it goes through.
  choose(false, true, true);
  try {
    yade::NewtonIntegrator::action();
  } catch (...) {
    choose(isDirty, isEnabled, isUsed);
    throw;
  }
  choose(isDirty, isEnabled, isUsed);
}

}  // namespace yadefrag
