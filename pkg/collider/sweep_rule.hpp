#pragma once
// The room of a body: where it may be before the next search.

#include <algorithm>
#include <cmath>

#include "abi/yade.hpp"
#include "core/tolerances/collider.hpp"

namespace yadefrag {

/// A cube in which the centre of a sphere may move until the next search.
struct Room {
  yade::Vector3r shift;  ///< m, of the cube's centre relative to that of the sphere
  double length;         ///< m, half the cube's edge; YADE's sweepLength
};

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

  /// The room of a sphere. If it is expected to keep its velocity, the room lies around the middle
  /// of its path instead of its position: half as long for the same number of steps, and where
  /// `most` limits it, it lasts twice as long.
  [[nodiscard]] Room roomFor(double radius, const yade::Vector3r& velocity, bool isStraight) const {
    const double speed = speedOf(velocity);
    const double around = lengthForBall(radius, speed);
    const bool isFinite = speed * ahead < INFINITY && speed > 0;
    if (!isStraight || !isFinite) return {yade::Vector3r::Zero(), around};
    const double path = speed * ahead / tolerance::kSweepSpare;
    constexpr double longer = 2 * tolerance::kSweepSpare - 1;  // the margin at the path's end only
    const double half = std::min(around, std::max(.5 * longer * path, least));
    return {velocity * (std::min(.5 * path, half / longer) / speed), half};
  }

  /// False if a sphere at `moved` (m) from its room's centre has left the room or will leave it
  /// soon, or is so slow that the room causes needless neighbours.
  [[nodiscard]] bool lasts(double length, const yade::Vector3r& moved,
                           const yade::Vector3r& velocity) const {
    // NaN in any component is outside.
    const auto isInside = [&](const yade::Vector3r& from) {
      return (from.array().abs() < length || from.array() == 0).all();
    };
    return isInside(moved) && isInside(moved + velocity * lookAhead) &&
           !isLoose(length, speedOf(velocity));
  }

  /// The same for any body that has moved by `moved` (m) in a room around its position.
  [[nodiscard]] bool lasts(double sweep, double moved, double speed) const {
    const double soon = moved + speed * lookAhead;
    return (soon < sweep || soon == 0) && !isLoose(sweep, speed);
  }

  /// True if a body has become so slow that its room is far too large.
  [[nodiscard]] bool isLoose(double length, double speed) const {
    return length > tolerance::kLooseSweep * lengthFor(speed);
  }

  /// The integrator requests a search when the largest component has reached the sweep.
  static double speedOf(const yade::Vector3r& velocity) { return velocity.cwiseAbs().maxCoeff(); }
};

}  // namespace yadefrag
