#pragma once
// How far a body may move before the next search must take place.

#include <algorithm>
#include <cmath>

#include "abi/yade.hpp"
#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// Every bound is enlarged by a length of its own, so that it holds for about `targetInterv` steps
/// at the body's present speed: fast bodies do not call for a search at every step, and slow ones
/// do not have neighbours they will not reach.
struct SweepRule {
  double most;                       ///< m, verletDist
  double least;                      ///< m, minSweepDistFactor · verletDist
  double ahead;                      ///< s, the time to be covered; not finite: always `most`
  double shortestPeriod = INFINITY;  ///< m, of a periodic cell
  double lookAhead = 0;              ///< s, for which a body's room should last if it is to be kept

  SweepRule(double verletDist, double minFactor, double dt, double interval)
      : most(verletDist),
        least(std::min(minFactor, 1.0) * verletDist),
        ahead(interval > 0 ? tolerance::kSweepSpare * dt * interval : INFINITY) {}

  [[nodiscard]] double lengthFor(double speed) const {
    const double wanted = speed * ahead;
    // A product that is not a number (0 · ∞, a broken velocity) gets the longest sweep.
    return wanted < most ? std::max(wanted, least) : most;
  }

  /// Length for a ball. In a small periodic cell two copies of one ball could come into contact
  /// with another before the next search, if it were longer.
  [[nodiscard]] double lengthForBall(double radius, double speed) const {
    const double room = (.25 * shortestPeriod - radius) / std::sqrt(3.);
    return std::min(lengthFor(speed), std::max(room, 0.));
  }

  /// False if a body that has moved by `moved` (m) within a room for `sweep` has left it or is
  /// about to, or is now so slow that the room costs needless neighbours.
  [[nodiscard]] bool lasts(double sweep, double moved, double speed) const {
    const double soon = moved + speed * lookAhead;
    return (soon < sweep || soon == 0) && sweep <= tolerance::kLooseSweep * lengthFor(speed);
  }

  /// The integrator asks for a search when the largest component has reached the sweep.
  static double speedOf(const yade::Vector3r& velocity) { return velocity.cwiseAbs().maxCoeff(); }
};

}  // namespace yadefrag
