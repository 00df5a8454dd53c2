#pragma once
// Rotation of bodies with three different moments of inertia, and motion of a clump's members: the
// formulas of YADE's NewtonIntegrator and Clump in the order of their operations, so that every bit
// is the same.

#include <cmath>

#include "loop/sphere_motion.hpp"

namespace yadefrag {

/// Cundall's damping of a torque.
inline void dampTorque(const MotionStep& step, const yade::State& state, yade::Vector3r& torque) {
  if (!state.isDamped) return;
  for (int i = 0; i < 3; ++i) {
    const double power = torque[i] * state.angVel[i];
    torque[i] *= 1 - step.damping * (power > 0 ? 1 : (power < 0 ? -1 : 0));
  }
}

/// Derivative (1/s) of an orientation; `spin` (rad/s) in the body's axes.
inline yade::Quaternionr orientationRate(const yade::Vector3r& spin, const yade::Quaternionr& at) {
  yade::Quaternionr rate;
  rate.w() = (-at.x() * spin[0] - at.y() * spin[1] - at.z() * spin[2]) / 2;
  rate.x() = (at.w() * spin[0] - at.z() * spin[1] + at.y() * spin[2]) / 2;
  rate.y() = (at.z() * spin[0] + at.w() * spin[1] - at.x() * spin[2]) / 2;
  rate.z() = (-at.y() * spin[0] + at.x() * spin[1] + at.w() * spin[2]) / 2;
  return rate;
}

/// Fincham 1992 (YADE's Allen 1989, p. 89): from the angular momentum, by a half step.
inline void turnByMomentum(const MotionStep& step, const yade::Vector3r& torque,
                           yade::State& state) {
  using yade::Matrix3r, yade::Quaternionr, yade::Vector3r;
  Quaternionr& orientation = state.se3.orientation;
  const Matrix3r toLocal = orientation.conjugate().toRotationMatrix();
  const Vector3r momentum = state.angMom + step.dt / 2. * torque;
  const Vector3r localMomentum = toLocal * momentum;
  Vector3r spin = localMomentum.cwiseQuotient(state.inertia);
  if (step.scalesDensity) spin *= state.densityScaling;
  const Quaternionr rate = orientationRate(spin, orientation);
  const Quaternionr half(orientation.coeffs() + step.dt / 2. * rate.coeffs());
  state.angMom += step.dt * torque;
  const Vector3r momentumAfter = toLocal * state.angMom;
  Vector3r spinAfter = momentumAfter.cwiseQuotient(state.inertia);
  if (step.scalesDensity) spinAfter *= state.densityScaling;
  const Quaternionr rateAfter = orientationRate(spinAfter, half);
  orientation = Quaternionr(orientation.coeffs() + step.dt * rateAfter.coeffs());
  state.angVel = orientation * spinAfter;
  orientation.normalize();
}

/// Euler's equations, in the body's axes: change of the spin (rad/s²).
inline yade::Vector3r eulerRate(const yade::Vector3r& spin, const yade::Vector3r& torque,
                                const yade::Vector3r& inertia) {
  return {(torque[0] + spin[1] * spin[2] * (inertia[1] - inertia[2])) / inertia[0],
          (torque[1] + spin[2] * spin[0] * (inertia[2] - inertia[0])) / inertia[1],
          (torque[2] + spin[0] * spin[1] * (inertia[0] - inertia[1])) / inertia[2]};
}

/// del Valle 2023, equation (9).
inline void turnBySpin(const MotionStep& step, const yade::Vector3r& torque, yade::State& state) {
  using yade::Matrix3r, yade::Quaternionr, yade::Vector3r;
  Quaternionr& orientation = state.se3.orientation;
  const Vector3r& inertia = state.inertia;
  const Matrix3r toLocal = orientation.conjugate().toRotationMatrix();
  Vector3r spin = toLocal * state.angVel;
  const Vector3r local = toLocal * torque;
  const Vector3r first = step.dt * eulerRate(spin, local, inertia);
  const Vector3r second = step.dt * eulerRate(spin + first, local, inertia);
  const Vector3r third = step.dt * eulerRate(spin + 0.25 * (first + second), local, inertia);
  Vector3r change((first + second + 4.0 * third) / 6.0);
  if (step.scalesDensity) change *= state.densityScaling;
  spin += change;
  if (const double square = spin.squaredNorm(); square != 0) {
    const double size = std::sqrt(square), angle = step.dt * size * 0.5;
    orientation = orientation * Quaternionr(std::cos(angle), std::sin(angle) * spin[0] / size,
                                            std::sin(angle) * spin[1] / size,
                                            std::sin(angle) * spin[2] / size);
  }
  if (step.normalizes) orientation.normalize();
  state.angMom = toLocal.transpose() * spin.cwiseProduct(inertia);
  if (step.scalesDensity) state.angMom /= state.densityScaling;
  state.angVel = toLocal.transpose() * spin;
}

/// The motion of a clump's member, which has the place `local` in the clump.
inline void moveMember(const yade::State& clump, const yade::Se3r& local, yade::State& member) {
  const yade::Se3r& to = clump.se3;
  member.se3.position = to.position + to.orientation * local.position;
  member.se3.orientation = to.orientation * local.orientation;
  member.vel = clump.vel + clump.angVel.cross(member.se3.position - to.position);
  member.angVel = clump.angVel;
}

}  // namespace yadefrag
