#pragma once
// Motion of one body over a step: the formulas of YADE's NewtonIntegrator for bodies whose rotation
// is integrated as a sphere's, in the order of their operations, so that every bit is the same.

#include <algorithm>
#include <cmath>

#include "abi/yade.hpp"

namespace yadefrag {

/// What is the same for all bodies of a step.
struct MotionStep {
  double dt;  // s
  double damping;
  yade::Vector3r gravity;  // m/s²
  bool isGravityDamped;
  bool scalesDensity;
  bool isPeriodic;
  int homoDeform;                // of the periodic cell
  yade::Matrix3r prevVelGrad;    // 1/s, of the step before
  yade::Matrix3r velGradChange;  // 1/s
  yade::Vector3r spinChange;     // rad/s, of the cell
};

/// Cundall's damping.
inline void damp(const MotionStep& step, const yade::Vector3r& velocity,
                 yade::Vector3r& acceleration) {
  for (int i = 0; i < 3; ++i) {
    const double power = acceleration[i] * (velocity[i] + .5 * step.dt * acceleration[i]);
    const int sign = (0 < power) - (power < 0);
    acceleration[i] *= 1 - step.damping * sign;
  }
}

/// The components of `free` along which the body may move; 0 for the others. `firstAxis`: the bit
/// of the first one.
inline yade::Vector3r unblocked(const yade::Vector3r& free, unsigned blocked, unsigned firstAxis) {
  if (blocked == 0) return free;
  yade::Vector3r kept = yade::Vector3r::Zero();
  for (int i = 0; i < 3; ++i)
    if (!(blocked & (firstAxis << i))) kept[i] += free[i];
  return kept;
}

inline void changeVelocity(const MotionStep& step, const yade::Vector3r& force,
                           const yade::Vector3r& torque, yade::State& state) {
  using yade::Vector3r;
  const unsigned blocked = state.blockedDOFs;
  if (blocked == yade::State::DOF_ALL) {
    if (step.isPeriodic && step.homoDeform > 1) {
      state.vel += step.dt * step.prevVelGrad * state.vel;
    }
    return;
  }
  Vector3r fluctuation = state.vel;
  if (step.isPeriodic) fluctuation = state.vel - step.prevVelGrad * state.se3.position;
  Vector3r change;
  if (step.isGravityDamped) {
    change = unblocked(force / state.mass + step.gravity, blocked, yade::State::DOF_X);
    if (step.scalesDensity) change *= state.densityScaling;
    if (state.isDamped) damp(step, fluctuation, change);
  } else {
    change = unblocked(force / state.mass, blocked, yade::State::DOF_X);
    if (state.isDamped) damp(step, fluctuation, change);
    change += unblocked(step.gravity, blocked, yade::State::DOF_X);
    if (step.scalesDensity) change *= state.densityScaling;
  }
  if (step.isPeriodic && step.homoDeform > 1) change += step.prevVelGrad * state.vel;
  state.vel += step.dt * change;

  Vector3r spin = unblocked(torque.cwiseQuotient(state.inertia), blocked, yade::State::DOF_RX);
  if (step.scalesDensity) spin *= state.densityScaling;
  if (state.isDamped) damp(step, state.angVel, spin);
  state.angVel += step.dt * spin;
}

inline void changePosition(const MotionStep& step, yade::State& state) {
  using yade::Quaternionr;
  using yade::Vector3r;
  const bool isDeformed = step.isPeriodic && step.homoDeform;
  if (isDeformed) {
    const Vector3r change = step.velGradChange * state.se3.position;
    state.vel += change;
  }
  state.se3.position += state.vel * step.dt;
  if (isDeformed) state.angVel += step.spinChange;
  Quaternionr& orientation = state.se3.orientation;
  if (const double square = state.angVel.squaredNorm(); square != 0) {
    const double speed = std::sqrt(square);
    const Quaternionr turn(
        Eigen::AngleAxis<double>(speed * step.dt, Vector3r(state.angVel / speed)));
    orientation = turn * orientation;
  }
  orientation.normalize();
}

/// True: the body has moved out of the region that the collider searched, and the collider must
/// search.
inline bool isBeyondBound(const yade::Bound& bound, const yade::State& state) {
  const yade::Vector3r moved = state.se3.position - bound.refPos;
  const double most =
      std::max(std::abs(moved[0]), std::max(std::abs(moved[1]), std::abs(moved[2])));
  return !(most == 0 || most < bound.sweepLength);
}

}  // namespace yadefrag
