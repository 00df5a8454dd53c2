#pragma once
// Lengths of time steps that follow each other, and wall-clock times of the stages of a step.

#include <chrono>

namespace yadefrag {

// --- Lengths of a time step whose neighbours have another length.

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

// --- Wall-clock time of the stages of a step. It is measured on request only.

/// (s) Sums over the steps.
struct StageTimes {
  double forces = 0;       ///< internal forces, time integration, work of the forces
  double search = 0;       ///< global search, and the test whether one is due
  double localSearch = 0;  ///< candidates → actives
  double correction = 0;   ///< actives → contact forces, positions, velocities
  double fracture = 0;     ///< strength check, cohesion, cracks and their consequences

  [[nodiscard]] double contact() const { return search + localSearch + correction; }
};

/// Adds the time of its own lifetime to one stage.
class StageTimer {
 public:
  /// `times` is null if nothing is measured.
  StageTimer(StageTimes* times, double StageTimes::*stage)
      : sum_(times ? &(times->*stage) : nullptr) {
    if (sum_) start_ = Clock::now();
  }
  ~StageTimer() {
    if (sum_) *sum_ += std::chrono::duration<double>(Clock::now() - start_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double* sum_;
  Clock::time_point start_;
};

}  // namespace yadefrag
