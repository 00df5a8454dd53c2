#pragma once
// Motion of one body over a step: the formulas of YADE's NewtonIntegrator for bodies whose rotation
// is integrated as a sphere's, in the order of their operations, so that every bit is the same.

#include <cmath>
#include <cstddef>

#include "core/four_lanes.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// What is the same for all bodies of a step.
struct MotionStep {
  double dt;  // s
  double damping;
  FourLanes gravity;  // m/s²
  bool isGravityDamped;
  bool scalesDensity;
  bool isPeriodic;
  int homoDeform;                // of the periodic cell
  yade::Matrix3r prevVelGrad;    // 1/s, of the step before
  yade::Matrix3r velGradChange;  // 1/s
  FourLanes spinChange;          // rad/s, of the cell
  // Of bodies with three different moments of inertia:
  bool turnsByMomentum = true;  // Fincham; otherwise del Valle
  bool normalizes = true;       // orientations, in this step, by del Valle
};

/// Product with a vector, with Eigen's order of additions.
[[gnu::always_inline]] inline FourLanes times(const yade::Matrix3r& matrix,
                                              const FourLanes& vector) {
  const yade::Vector3r product = matrix * yade::Vector3r(vector[0], vector[1], vector[2]);
  return loadThree(product.data());
}

/// Cundall's damping.
[[gnu::always_inline]] inline void damp(const MotionStep& step, const FourLanes& velocity,
                                        FourLanes& acceleration) {
  const FourLanes none = {}, one = none + 1;
  const FourLanes power = acceleration * (velocity + .5 * step.dt * acceleration);
  const FourLanes sign = power > none ? one : (power < none ? -one : none);
  acceleration *= 1 - step.damping * sign;
}

/// The components of `free` along which the body may move; 0 for the others. `firstAxis`: the bit
/// of the first one.
[[gnu::always_inline]] inline FourLanes unblocked(FourLanes free, unsigned blocked,
                                                  unsigned firstAxis) {
  if (blocked == 0) return free;
  for (int i = 0; i < 3; ++i) free[i] = blocked & (firstAxis << i) ? 0 : 0 + free[i];
  return free;
}

[[gnu::always_inline]] inline FourLanes acceleration(const MotionStep& step, const FourLanes& force,
                                                     const FourLanes& velocity,
                                                     const yade::State& state) {
  const unsigned blocked = state.blockedDOFs;
  FourLanes fluctuation = velocity;
  if (step.isPeriodic) {
    fluctuation = velocity - times(step.prevVelGrad, loadThree(state.se3.position.data()));
  }
  FourLanes change = force / state.mass;
  if (step.isGravityDamped) {
    change = unblocked(change + step.gravity, blocked, yade::State::DOF_X);
    if (step.scalesDensity) change *= state.densityScaling;
    if (state.isDamped) damp(step, fluctuation, change);
  } else {
    change = unblocked(change, blocked, yade::State::DOF_X);
    if (state.isDamped) damp(step, fluctuation, change);
    change += unblocked(step.gravity, blocked, yade::State::DOF_X);
    if (step.scalesDensity) change *= state.densityScaling;
  }
  if (step.isPeriodic && step.homoDeform > 1) change += times(step.prevVelGrad, velocity);
  return change;
}

[[gnu::always_inline]] inline FourLanes spinAcceleration(const MotionStep& step,
                                                         const FourLanes& torque,
                                                         const FourLanes& spin,
                                                         const yade::State& state) {
  FourLanes change =
      unblocked(torque / loadThree(state.inertia.data()), state.blockedDOFs, yade::State::DOF_RX);
  if (step.scalesDensity) change *= state.densityScaling;
  if (state.isDamped) damp(step, spin, change);
  return change;
}

/// Velocity, spin and position at the end of the step; not the spin of bodies with three different
/// moments of inertia (`turnsAsSphere`).
template <bool turnsAsSphere = true>
[[gnu::always_inline]] inline void changePlace(const MotionStep& step, const FourLanes& force,
                                               const FourLanes& torque, yade::State& state) {
  FourLanes velocity = loadThree(state.vel.data());
  FourLanes spin = loadThree(state.angVel.data());
  FourLanes position = loadThree(state.se3.position.data());
  if (state.blockedDOFs != yade::State::DOF_ALL) {
    velocity += step.dt * acceleration(step, force, velocity, state);
    if constexpr (turnsAsSphere) spin += step.dt * spinAcceleration(step, torque, spin, state);
  } else if (step.isPeriodic && step.homoDeform > 1) {
    const yade::Vector3r change = step.dt * step.prevVelGrad * state.vel;
    velocity += loadThree(change.data());
  }
  if (step.isPeriodic && step.homoDeform) {
    velocity += times(step.velGradChange, position);
    if constexpr (turnsAsSphere) spin += step.spinChange;
  }
  position += velocity * step.dt;
  storeThree(velocity, state.vel.data());
  if constexpr (turnsAsSphere) storeThree(spin, state.angVel.data());
  storeThree(position, state.se3.position.data());
}

/// Orientation at the end of the step.
[[gnu::always_inline]] inline void changeOrientation(double dt, yade::State& state) {
  double* const stored = state.se3.orientation.coeffs().data();
  FourLanes orientation = loadFour(stored);
  const FourLanes spin = loadThree(state.angVel.data());
  if (const double square = squaredNorm(spin); square != 0) {
    const double speed = std::sqrt(square), angle = .5 * (speed * dt);
    FourLanes turn = std::sin(angle) * (spin / speed);
    turn[3] = std::cos(angle);
    orientation = quaternionProduct(turn, orientation);
  }
  const double square = squaredNormOfFour(orientation);
  if (square > 0) orientation /= std::sqrt(square);
  storeFour(orientation, stored);
}

/// True: the body has moved out of the region that the collider searched, and the collider must
/// search.
[[gnu::always_inline]] inline bool isBeyondBound(const yade::Bound& bound,
                                                 const yade::State& state) {
  static_assert(offsetof(yade::Bound, sweepLength) == offsetof(yade::Bound, refPos) + 24);
  const FourLanes room = loadFour(bound.refPos.data());  // with the sweep as its last component
  const FourLanes change = loadThree(state.se3.position.data()) - room, none = {};
  const FourLanes moved = change < none ? -change : change;
  const auto beyond = (moved != none) & ~(moved < permuted<3, 3, 3, 3>(room));
  return (beyond[0] | beyond[1] | beyond[2]) != 0;
}

}  // namespace yadefrag
