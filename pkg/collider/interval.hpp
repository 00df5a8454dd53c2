#pragma once
// Choice of the interval: the number of steps for which the bounds are made.

#include <algorithm>
#include <cmath>

#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// Long sweeps cause few searches and many potential interactions. Let W be the work of the
/// searches in k steps (in units of a body's share in a full search), and H the number of pairs
/// that are near only because the sweeps are not half as long. A step then costs about search·W/k +
/// pair·(rest + 2H). The first term is inverse to the interval, the last one proportional: the sum
/// is smallest where both are equal. All quantities are counted, not timed, so that a run is
/// reproducible.
class Interval {
 public:
  /// Adds a search that was due because a body had left its swept box. It checked `checked` bodies
  /// and searched `searched` bodies; `halves` is the number of near neighbours of these that would
  /// not be near with sweeps half as long.
  void add(double checked, double searched, double halves) {
    work_ += searched == checked
                 ? searched
                 : tolerance::kCheckWork * checked + tolerance::kChangeWork * searched;
    searched_ += searched;
    halves_ += halves;
  }
  void addSteps(double steps) { steps_ += steps; }

  /// True if most moving bodies have been searched since the last call of `next`.
  [[nodiscard]] bool isRound(double interval, double bodies) const {
    return searched_ >= bodies || steps_ >= 2 * interval;
  }

  /// Returns the new interval, and resets the counts.
  double next(double interval, double bodies) {
    const double times = std::max(steps_ / interval, 1.);  // searches per moving body
    const double pairs = .5 * halves_ / times;
    const double ratio = searchOverPair(bodies) * work_ / (2 * pairs * steps_ + 1);
    const bool known = steps_ > 0 && work_ > 0;
    *this = {};
    if (!known) return interval;
    return std::clamp(interval * std::clamp(std::sqrt(ratio), tolerance::kIntervalShrinking,
                                            tolerance::kIntervalGrowth),
                      tolerance::kLeastInterval, tolerance::kMostInterval);
  }

 private:
  /// Time of a search per body over that of a potential interaction per step.
  static double searchOverPair(double bodies) {
    using namespace tolerance;
    return std::clamp(kSearchOverPair * std::pow(kCachedBodies / bodies, kCacheExponent),
                      kLeastSearchOverPair, kSearchOverPair);
  }

  double work_ = 0, searched_ = 0, halves_ = 0, steps_ = 0;
};

}  // namespace yadefrag
