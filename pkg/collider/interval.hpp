#pragma once
// For how many steps a search should hold.

#include <algorithm>
#include <cmath>

#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// Long sweeps make searches rare and potential interactions many. With N bodies, k steps since the
/// last search and H pairs that are near only because sweeps are not half as long, a step costs
/// about search·N/k + pair·(rest + 2H), of which the last part grows with the interval: the sum is
/// least where search·N = pair·2H·k. All of it is counted and nothing timed, so that a run stays
/// reproducible.
class Interval {
 public:
  static double next(double interval, double bodies, double steps, double pairsOfHalf) {
    if (!(steps > 0)) return interval;
    const double ratio = searchOverPair(bodies) * bodies / (2 * pairsOfHalf * steps + 1);
    return std::clamp(interval * std::clamp(std::sqrt(ratio), .5, tolerance::kIntervalGrowth),
                      tolerance::kLeastInterval, tolerance::kMostInterval);
  }

 private:
  /// Time of a search per body over that of a potential interaction per step: about 0.25 µs over
  /// 0.06 µs while a scene fits the processor's caches, over 0.3 µs where every interaction is
  /// fetched from memory (2-core machine, November 2026). The caches end between 3·10³ and 10⁵
  /// bodies.
  static double searchOverPair(double bodies) {
    return std::clamp(4 * std::pow(3000 / bodies, .4), 1., 4.);
  }
};

}  // namespace yadefrag
