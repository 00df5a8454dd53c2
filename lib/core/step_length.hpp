#pragma once
// Lengths of a time step whose neighbours have another length.

namespace yadefrag {

/// Central differences: positions are integrated from n to n + 1, but velocities from the middle of
/// the last step to the middle of this one. If velocities used the position's step, each change of
/// the step would be an error of first order, and steps that change all the time would add energy
/// to all vibration modes.
struct StepLength {
  double position;  ///< s, Δtⁿ
  double velocity;  ///< s, ½(Δtⁿ⁻¹ + Δtⁿ)

  // NOLINTNEXTLINE(google-explicit-constructor): a number is a step whose neighbours have the same
  // length
  StepLength(double dt) : position(dt), velocity(dt) {}
  /// `last` (s): the previous step; 0 if there was none.
  StepLength(double dt, double last) : position(dt), velocity(last > 0 ? (last + dt) / 2 : dt) {}

  /// (s²) Displacement per acceleration in the step: u = squared() F/m.
  [[nodiscard]] double squared() const { return position * velocity; }
};

}  // namespace yadefrag
