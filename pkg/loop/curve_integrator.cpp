#include "loop/curve_integrator.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <typeinfo>

#include "core/lanes.hpp"
#include "core/parallel.hpp"
#include "core/request.hpp"
#include "yade/helpers.hpp"
#include "yade/running.hpp"

namespace yadefrag {

namespace {

// Bodies between the request of data from memory and their use: enough for the latency of one
// access.
constexpr std::size_t kAhead = 16;
// Bodies that change place, then orientation: more of them are then computed at the same time than
// if all of a body's formulas, each of which waits for the one before, came first.
constexpr std::size_t kBlock = 16;
const InstructionSet kInstructions = bestInstructionSet();

const yade::Clump* clumpOf(const yade::Body& body) {
  const yade::Shape* const shape = body.isClump() ? body.shape.get() : nullptr;
  return shape && typeid(*shape) == typeid(yade::Clump) ? static_cast<const yade::Clump*>(shape)
                                                        : nullptr;
}

/// What `move` uses of a body, then of its state and bound, and of a clump's members.
[[gnu::always_inline]] inline void requestAhead(
    const std::vector<yade::shared_ptr<yade::Body>>& bodies, std::size_t index) {
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
    if (body->isClump()) request(body->shape.get(), 0, sizeof(yade::Clump));
  }
  const Body* const next = bodies[index + kAhead / 2].get();
  const yade::Clump* const clump = next ? clumpOf(*next) : nullptr;
  if (clump == nullptr || clump->members.empty()) return;
  request(&*clump->members.begin(), 0, sizeof(yade::Clump::MemberMap::value_type));
  request(&*clump->members.rbegin(), 0, sizeof(yade::Clump::MemberMap::value_type));
}

// Rotations of YADE from 2025.2 on; those before turn by momentum.
template <class Integrator>
void readRotations(const Integrator& integrator, MotionStep& step) {
  if constexpr (requires { integrator.rotAlgorithm; }) {
    const int every = integrator.normalizeEvery;
    step.turnsByMomentum = integrator.rotAlgorithm == Integrator::RotAlgorithm::Fincham1992;
    step.normalizes = every != 0 && integrator.scene->iter % every == 0;
  }
}
template <class Integrator>
bool turnsByOmelyan(const Integrator& integrator) {
  if constexpr (requires { integrator.rotAlgorithm; }) {
    return integrator.rotAlgorithm == Integrator::RotAlgorithm::Omelyan1998;
  }
  return false;
}

}  // namespace

void MotionIntegrator::readStep(MotionStep& step) const {
  const yade::Cell& cell = *scene->cell;
  step.dt = scene->dt;
  step.damping = damping;
  step.gravity = loadThree(gravity.data());
  step.isGravityDamped = dampGravity;
  step.scalesDensity = densityScaling;
  step.isPeriodic = scene->isPeriodic;
  step.homoDeform = cell.homoDeform;
  step.prevVelGrad = prevVelGrad;
  const bool isChanged = cell.velGradChanged || cell.nextVelGrad != yade::Matrix3r::Zero();
  step.velGradChange = (isChanged ? cell.nextVelGrad : cell.velGrad) - prevVelGrad;
  const yade::Matrix3r turn = .5 * (step.velGradChange - step.velGradChange.transpose());
  step.spinChange = FourLanes{-turn(1, 2), turn(0, 2), -turn(0, 1), 0};
  readRotations(*this, step);
}

[[gnu::always_inline]] inline bool MotionIntegrator::turnsAsSphere(const yade::Body& body) const {
  constexpr unsigned kRotations = yade::State::DOF_RX | yade::State::DOF_RY | yade::State::DOF_RZ;
  const bool isAspherical = (body.flags & yade::Body::FLAG_ASPHERICAL) != 0;
  return !(isAspherical && exactAsphericalRot && (body.state->blockedDOFs & kRotations) == 0);
}

// False: there is a body that YADE's functions would report.
bool MotionIntegrator::findMembers(const yade::Clump& clump, std::vector<Member>& members) const {
  for (const auto& [id, local] : clump.members) {
    const yade::Body* const body = bodyAt(scene->bodies->body, id);
    if (!body || !forces_.has(static_cast<std::size_t>(id))) return false;
    members.push_back({body, &local});
  }
  return true;
}

// YADE's NewtonIntegrator::action, for one body.
[[gnu::always_inline]] inline MotionIntegrator::Way MotionIntegrator::wayOf(
    const yade::Body& body) const {
  if (body.isClumpMember()) return Way::kNot;
  if (mask > 0 && (body.groupMask & mask) == 0) return Way::kNot;
#ifdef YADE_MPI
  if (scene->subdomain != body.subdomain || body.getIsSubdomain() || body.getIsFluidDomainBbox()) {
    return Way::kNot;
  }
#endif
  const bool isSphere = turnsAsSphere(body);
  if (isSphere && body.isStandalone()) return Way::kAsSphere;
  if (!isSphere && turnsByOmelyan(*this)) return Way::kByYade;
  if (body.isStandalone()) return Way::kApart;
  const bool isKnown = clumpOf(body) && forces_.has(static_cast<std::size_t>(body.id));
  return isKnown ? Way::kApart : Way::kByYade;
}

// YADE's Clump::addForceTorqueFromMembers: O.forces has the sum afterwards.
[[gnu::always_inline]] inline void MotionIntegrator::sumOfMembers(
    const yade::Body& body, const std::vector<Member>& members) const {
  FourLanes force{}, torque{};
  const FourLanes centre = loadThree(body.state->se3.position.data());
  for (const Member& member : members) {
    const auto id = static_cast<std::size_t>(member.body->id);
    const FourLanes on = forces_.forceOn(id);
    const FourLanes arm = loadThree(member.body->state->se3.position.data()) - centre;
    force += on, torque += forces_.torqueOn(id) + cross(arm, on);
  }
  forces_.addTo(static_cast<std::size_t>(body.id), force, torque);
}

[[gnu::always_inline]] inline void MotionIntegrator::moveApart(const MotionStep& step,
                                                               const yade::Body& body,
                                                               Part& part) const {
  part.members.clear();
  if (body.isClump()) {
    if (!findMembers(static_cast<const yade::Clump&>(*body.shape), part.members)) {
      return part.others.push_back(body.id);
    }
    sumOfMembers(body, part.members);
  }
  const auto id = static_cast<std::size_t>(body.id);
  const FourLanes force = forces_.forceOn(id), torque = forces_.torqueOn(id);
  yade::State& state = *body.state;
  if (turnsAsSphere(body)) {
    changePlace(step, force, torque, state);
    changeOrientation(step.dt, state);
  } else {
    yade::Vector3r about;
    storeThree(torque, about.data());
    changePlace<false>(step, force, torque, state);
    dampTorque(step, state, about);
    step.turnsByMomentum ? turnByMomentum(step, about, state) : turnBySpin(step, about, state);
  }
  const auto note = [&](const yade::Body& moved) {
    if (moved.bound && isBeyondBound(*moved.bound, *moved.state)) part.isAnyBeyond = true;
  };
  note(body);
  ++part.moved;
  for (const Member& member : part.members) {
    moveMember(state, *member.local, *member.body->state);
    note(*member.body);
  }
}

[[gnu::always_inline]] inline void MotionIntegrator::moveBlock(const MotionStep& step,
                                                               std::size_t begin, std::size_t end,
                                                               Part& part) const {
  const auto& bodies = scene->bodies->body;
  std::array<yade::State*, kBlock> moved;
  std::size_t numMoved = 0;
  for (std::size_t index = begin; index < end; ++index) {
    requestAhead(bodies, index);
    if (!bodies[index]) continue;
    const yade::Body& body = *bodies[index];
    const Way way = wayOf(body);
    if (way == Way::kByYade) part.others.push_back(body.id);
    if (way == Way::kApart) moveApart(step, body, part);
    if (way != Way::kAsSphere) continue;
    yade::State& state = *body.state;
    const auto id = static_cast<std::size_t>(body.id);
    changePlace(step, forces_.forceOn(id), forces_.torqueOn(id), state);
    if (body.bound && isBeyondBound(*body.bound, state)) part.isAnyBeyond = true;
    moved[numMoved++] = &state;
  }
  for (std::size_t k = 0; k < numMoved; ++k) changeOrientation(step.dt, *moved[k]);
  part.moved += static_cast<long>(numMoved);
}

void MotionIntegrator::action() try {
  fastBodies = 0;
  if (leftOutIn_ != scene->iter) leftOut_.clear();
  leftOutIn_ = -1;
  if (!isFast(*scene)) return callYades();
  scene->forces.sync();
  memory_.endStep(*scene);
  const auto& bodies = scene->bodies->body;
  MotionStep step = {};
  readStep(step);
  forces_ = SummedForces(scene->forces, bodies.size());
  const int most = omp_get_max_threads();
  parts_.assign(static_cast<std::size_t>(most), {});
  forEachPart(bodies.size(), most, [&](std::size_t begin, std::size_t end, int number) {
    Part part;
    runFor(
        kInstructions, [&]() __attribute__((always_inline)) {
          forOutside(
              leftOut_, begin,
              end, [&](std::size_t first, std::size_t last) __attribute__((always_inline)) {
                for (std::size_t block = first; block < last; block += kBlock) {
                  moveBlock(step, block, std::min(block + kBlock, last), part);
                }
              });
        });
    parts_[static_cast<std::size_t>(number)] = part;
  });
  std::vector<yade::Body::id_t> others;
  bool isAnyBeyond = !leftOut_.empty() && isLeftOutBeyond_;
  for (const Part& part : parts_) {
    others.insert(others.end(), part.others.begin(), part.others.end());
    fastBodies += part.moved;
    isAnyBeyond = isAnyBeyond || part.isAnyBeyond;
  }
  moveOthers(others);
  if (fastBodies == 0 && leftOut_.empty()) return;
  // What NewtonIntegrator tells the collider: LebesgueCollider reads it by threads.
  const double told = isAnyBeyond ? 2 : .5;
  maxVelocitySq = std::max(maxVelocitySq, told);
  threadMaxVelocitySq.at(0) = std::max(threadMaxVelocitySq.at(0), told);
} catch (const std::exception& error) {
  noteStop(error.what());
  throw;
}

void MotionIntegrator::leaveOut(const yade::Scene& now, const IdRanges& moved, bool areSearched) {
  leftOut_ = moved;
  leftOutIn_ = now.iter;
  isLeftOutBeyond_ = false;
  if (!areSearched) return;
  const auto& bodies = now.bodies->body;
  for (const IdRange& range : moved) {
    for (std::size_t id = range.begin; id < range.end; ++id) {
      const yade::Body* const body = bodyAt(bodies, id);
      if (body && body->bound && isBeyondBound(*body->bound, *body->state)) isLeftOutBeyond_ = true;
    }
  }
}

void MotionIntegrator::callYades() {
  timingDeltas.swap(yadesDeltas_);
  try {
    yade::NewtonIntegrator::action();
  } catch (...) {
    timingDeltas.swap(yadesDeltas_);
    throw;
  }
  timingDeltas.swap(yadesDeltas_);
}

// YADE does here, too, what it does once in a step: the cell's velocity gradient, warnings.
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
    callYades();
  } catch (...) {
    choose(isDirty, isEnabled, isUsed);
    throw;
  }
  choose(isDirty, isEnabled, isUsed);
}

}  // namespace yadefrag
