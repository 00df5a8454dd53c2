#pragma once
// The room of a body: where it may be before the next search.

#include <algorithm>
#include <cmath>

#include "core/tolerances/collider.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

/// A cube in which the centre of a sphere may move until the next search.
struct SweptBox {
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
  [[nodiscard]] SweptBox sweptBoxOf(double radius, const yade::Vector3r& velocity,
                                    bool isStraight) const {
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

  /// False if a body that is `moved` (m) from its room's centre leaves it soon, or is too slow.
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

// --- Choice of the interval: the number of steps for which the bounds are made.

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
