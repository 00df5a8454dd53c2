#pragma once
// For how many steps a body's room should last.

#include <algorithm>
#include <cmath>

#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// Long sweeps make searches rare and potential interactions many. Where searches have taken the
/// work W (in looks at a body by a search of all) in k steps, and H pairs are near only because
/// sweeps are not half as long, a step costs about search·W/k + pair·(rest + 2H). The first part is
/// inverse to the interval, the last one proportional: the sum is least where both are equal. All
/// of it is counted and nothing timed, so that a run stays reproducible.
class Interval {
 public:
  /// A search that was due because a body had left its room: it looked whether `looked` bodies have
  /// left theirs and searched `searched` bodies; `halves` times one of these had a near neighbour
  /// that it would not have with sweeps half as long.
  void add(double looked, double searched, double halves) {
    work_ += searched == looked ? searched
                                : tolerance::kLookWork * looked + tolerance::kChangeWork * searched;
    searched_ += searched;
    halves_ += halves;
  }
  void addSteps(double steps) { steps_ += steps; }

  /// True if most bodies that move have been searched since the last call of `next`.
  [[nodiscard]] bool isRound(double interval, double bodies) const {
    return searched_ >= bodies || steps_ >= 2 * interval;
  }

  /// The interval from now on, and the count starts anew.
  double next(double interval, double bodies) {
    const double times = std::max(steps_ / interval, 1.);  // that a moving body was searched
    const double pairs = .5 * halves_ / times;
    const double ratio = searchOverPair(bodies) * work_ / (2 * pairs * steps_ + 1);
    const bool known = steps_ > 0 && work_ > 0;
    *this = {};
    if (!known) return interval;
    return std::clamp(interval * std::clamp(std::sqrt(ratio), .5, tolerance::kIntervalGrowth),
                      tolerance::kLeastInterval, tolerance::kMostInterval);
  }

 private:
  /// Time of a search per body over that of a potential interaction per step: about 0.25 µs over
  /// 0.06 µs while a scene fits the processor's caches, over 0.3 µs where every interaction is
  /// fetched from memory (2-core machine, November 2026). The caches end between 3·10³ and 10⁵
  /// bodies.
  static double searchOverPair(double bodies) {
    return std::clamp(4 * std::pow(3000 / bodies, .4), 1.5, 4.);
  }

  double work_ = 0, searched_ = 0, halves_ = 0, steps_ = 0;
};

}  // namespace yadefrag
