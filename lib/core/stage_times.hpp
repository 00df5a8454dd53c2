#pragma once
// Wall-clock time of the stages of a step. It is measured on request only.

#include <chrono>

namespace yadefrag {

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
