#pragma once
// A step between others of another length.

namespace yadefrag {

/// Central differences take positions from n to n + 1, but velocities from the middle of the last
/// step to the middle of this one. With the velocity's step as long as the position's, each change
/// of the step would be an error of first order, and steps that change all the time would feed
/// energy to all modes.
struct StepLength {
  double position;  ///< s, Δtⁿ
  double velocity;  ///< s, ½(Δtⁿ⁻¹ + Δtⁿ)

  // NOLINTNEXTLINE(google-explicit-constructor): a number is a step among others of its length
  StepLength(double dt) : position(dt), velocity(dt) {}
  /// `last` (s): the step before; 0 if there was none.
  StepLength(double dt, double last) : position(dt), velocity(last > 0 ? (last + dt) / 2 : dt) {}

  /// (s²) How far a force moves a mass in the step: u = squared() F/m.
  [[nodiscard]] double squared() const { return position * velocity; }
};

}  // namespace yadefrag
