// One edge between two triangles, driven apart: what holds it, against the law's curve.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/cohesive_law.hpp"
#include "fracture/two_triangles.hpp"

namespace yadefrag::test {
namespace {

/// What the law gives in a step between two openings: while they grow, that at the step's begin.
double lawful(const TensionLaw& law, double& largest, double begin, double end) {
  const double most = envelope(law, largest);
  const double traction = largest > 0 && end < largest ? most * std::max(0., end) / largest : most;
  largest = std::max({largest, begin, end});
  return traction;
}

struct RunResult {
  double worstTraction = 0;  // of the strength
  double worstEnergy = 0;    // of Gc·A
  double leastOpening = 0;   // m
  double largestStep = 0;    // m, opening in a step
  double spent = 0;          // of Gc·A
};

/// Through the wanted openings in turn (of δc), each half at 50 m/s: in so many steps from 0 to δc.
RunResult run(std::initializer_list<double> turns, int steps, const SofteningCurve& curve = {}) {
  constexpr double kSpeed = 50;
  const TensionLaw law{curve, kStrength, curve.criticalOpening(kStrength, kEnergy)};
  const double critical = law.criticalOpening;
  const double dt = critical / (2 * kSpeed) / steps;
  BodySpec spec;
  spec.brittle.softening = curve;
  DrivenPair pair(spec, dt);
  const auto least = [&] { return std::min(pair.opening(0).x, pair.opening(1).x); };
  double largest[2] = {0, 0};
  RunResult result;
  for (const double turn : turns) {
    const double sign = turn * critical > least() ? 1 : -1;
    // Those that are to close further than shut never come there.
    for (int n = 0; n < 2 * steps && sign * (turn * critical - least()) > 0; ++n) {
      if (n == 0) pair.drive({sign * kSpeed, 0});
      const double begin[2] = {pair.opening(0).x, pair.opening(1).x};
      pair.step();
      double wanted = 0;
      for (std::size_t end = 0; end < 2; ++end) {
        wanted += lawful(law, largest[end], begin[end], pair.opening(end).x) / 2;
        result.largestStep =
            std::max(result.largestStep, std::abs(pair.opening(end).x - begin[end]));
      }
      result.leastOpening = std::min(result.leastOpening, least());
      // Shut faces push, too.
      if (least() > 1e-6 * critical)
        result.worstTraction =
            std::max(result.worstTraction, std::abs(pair.traction.x - wanted) / kStrength);
    }
  }
  result.worstEnergy = pair.worstEnergy / (kEnergy * kArea);
  result.spent = pair.world.ledger.fracture / (kEnergy * kArea);
  return result;
}

// The traction computed from the momentum is the law's to rounding (3e-13; momenta are 10⁴ times
// what a step changes). So is the energy: 10⁻⁹ leaves room for strains of 10⁻⁵, of which the
// leapfrog's invariant neglects the square. The work is the sum of trapezoids below a straight
// line, exact but for the last step, which ends beyond δc: a triangle of at most ½σc Δδ²/δc,
// (Δδ/δc)² of Gc.
TEST(ModeOne, OpeningSpendsTheFractureEnergy) {
  for (const int steps : {40, 100, 400}) {
    const RunResult result = run({1.2}, steps);
    EXPECT_LT(result.worstTraction, 1e-11) << steps;
    EXPECT_LT(result.worstEnergy, 1e-9) << steps;
    const double part = result.largestStep / kCritical;
    EXPECT_LT(std::abs(result.spent - 1), part * part + 1e-9) << steps;
  }
}

// The same for every curve. Its knees have errors of second order: a step across one cuts a
// triangle of at most ½Δs Δδ²/4, where Δs is the change of slope; all together at most the steepest
// slope.
TEST(ModeOne, EveryCurveSpendsTheFractureEnergy) {
  for (const auto& [name, curve] : softeningCurves()) {
    double error[2];
    for (const int k : {0, 1}) {
      const RunResult result = run({1.2}, k == 0 ? 400 : 1600, curve);
      EXPECT_LT(result.worstTraction, 1e-10) << name;
      EXPECT_LT(result.worstEnergy, 1e-9) << name;
      error[k] = std::abs(result.spent - 1);
    }
    EXPECT_LT(error[0], 1e-3) << name;
    EXPECT_LT(error[1], 1e-3 / 16 + 1e-8) << name;
  }
}

// Unloading and reloading go by the line through the origin, to rounding as well. On it the
// traction is that of the step's end, half a chord late both ways, so that stiff lines do no harm:
// that spends 2·T(δmax)/δmax·Δδ for every opening that is closed and opened again, which is of
// first order in the step: 2.9 Δδ/δc of Gc in this course, and half as much with half the step.
TEST(ModeOne, UnloadsTowardsTheOriginAndBack) {
  double more[2];
  for (const int k : {0, 1}) {
    const RunResult result = run({.4, .1, .6, .2, 1.2}, k == 0 ? 200 : 400);
    EXPECT_LT(result.worstTraction, 1e-11) << k;
    EXPECT_LT(result.worstEnergy, 1e-9) << k;
    more[k] = result.spent - 1;
    EXPECT_GT(more[k], 0) << k;
    EXPECT_LT(more[k], 4 * result.largestStep / kCritical) << k;
  }
  EXPECT_NEAR(more[0] / more[1], 2, .2);
}

TEST(ModeOne, EveryCurveUnloadsTowardsTheOriginAndBack) {
  for (const auto& [name, curve] : softeningCurves()) {
    const RunResult result = run({.4, .1, .6, .2, 1.2}, 1600, curve);
    EXPECT_LT(result.worstTraction, 1e-10) << name;
    EXPECT_LT(result.worstEnergy, 1e-9) << name;
    EXPECT_GT(result.spent, 1 - 1e-4) << name;
    EXPECT_LT(result.spent, 1.01) << name;
  }
}

// Faces that are driven against each other while they still hold stop where they touch, and what
// is left of the law is as it was.
TEST(ModeOne, ShutFacesStayApart) {
  const RunResult result = run({.4, -.1, 1.2}, 200);
  EXPECT_GT(result.leastOpening, -1e-9 * kCritical);
  EXPECT_LT(result.worstTraction, 1e-11);
  EXPECT_LT(result.worstEnergy, 1e-9);
}

/// (rad) Two halves turn about an end which still holds, by more than half a turn: the angle
/// between them from which on nothing holds. `strength`: Pa, once the edge has cracked.
double doorsRelease(double strength) {
  constexpr double kDt = 1e-10, kSpin = 5e5;  // s, rad/s of each half: a step turns them 10⁻⁴ rad
  DrivenPair pair({}, kDt);
  World& world = pair.world;
  world.fracture.edges.strength[0] = strength;
  Nodes& nodes = world.model.nodes;
  for (std::size_t element = 0; element < 2; ++element) {
    const auto& corners = world.model.triangles.nodes[element];
    const Vec2 hinge = nodes.position[corners[0].value];
    for (const NodeId node : corners) {
      const Vec2 arm = nodes.position[node.value] - hinge;
      nodes.velocity[node.value] = (element == 0 ? kSpin : -kSpin) * Vec2{-arm.y, arm.x};
    }
  }
  const double start = totalEnergy(world);
  double worst = 0, turned = 0, released = 0;
  for (int n = 0; n < 40000; ++n) {
    world.step(kDt);
    worst = std::max(worst, std::abs(totalEnergy(world) / start - 1));
    turned += 2 * kSpin * kDt;
    if (released == 0 && world.fracture.cohesion.edge.empty()) released = turned;
  }
  EXPECT_GT(turned, 1.1 * std::numbers::pi);
  EXPECT_LT(worst, 1e-6);
  return released;
}

// An end that is open by 2δc breaks the whole edge. One that is so soft that it would be open by
// less at a right angle breaks there, where the faces have no common normal any more. Halves turn a
// little slower once the opening has taken its part.
TEST(ModeOne, ADoorOpensAllTheWayRound) {
  EXPECT_NEAR(doorsRelease(kStrength) / (2 * kCritical / kArea), 1, .1);
  EXPECT_NEAR(doorsRelease(1e6), std::numbers::pi / 2, .2);
}

}  // namespace
}  // namespace yadefrag::test
