#pragma once
// Permitted displacement of a body before the next search.

#include <algorithm>
#include <cmath>

#include "abi/yade.hpp"
#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// Every bound is enlarged by an individual length, so that it is valid for about `targetInterv`
/// steps at the body's present speed. Fast bodies then do not require a search at every step, and
/// slow ones do not have neighbours out of their reach.
struct SweepRule {
  double most;   ///< m, verletDist
  double least;  ///< m, minSweepDistFactor · verletDist
  double ahead;  ///< s, time for which the bound must be valid; not finite: always `most`
  double shortestPeriod = INFINITY;  ///< m, of a periodic cell
  double lookAhead = 0;              ///< s, remaining validity with which a swept box is kept

  SweepRule(double verletDist, double minFactor, double dt, double interval)
      : most(verletDist),
        least(std::min(minFactor, 1.0) * verletDist),
        ahead(interval > 0 ? tolerance::kSweepSpare * dt * interval : INFINITY) {}

  [[nodiscard]] double lengthFor(double speed) const {
    const double wanted = speed * ahead;
    // A product that is NaN (0 · ∞, an invalid velocity) gives the longest sweep.
    return wanted < most ? std::max(wanted, least) : most;
  }

  /// Length for a sphere. In a small periodic cell a longer one would allow two copies of one
  /// sphere to touch the same sphere before the next search.
  [[nodiscard]] double lengthForBall(double radius, double speed) const {
    const double room = (.25 * shortestPeriod - radius) / std::sqrt(3.);
    return std::min(lengthFor(speed), std::max(room, 0.));
  }

  /// False if a body that has moved by `moved` (m) within a swept box for `sweep` has left it or is
  /// about to, or is so slow that the box causes needless neighbours.
  [[nodiscard]] bool lasts(double sweep, double moved, double speed) const {
    const double soon = moved + speed * lookAhead;
    return (soon < sweep || soon == 0) && sweep <= tolerance::kLooseSweep * lengthFor(speed);
  }

  /// The integrator requests a search when the largest component has reached the sweep.
  static double speedOf(const yade::Vector3r& velocity) { return velocity.cwiseAbs().maxCoeff(); }
};

}  // namespace yadefrag
