// A square plate with a notch from the left side, pulled slowly: whatever way the mesh is turned,
// the crack goes straight across and the plate bears the same.
//
//    ↑ ↑ ↑ ↑ ↑ ↑    clamped, 30 × 30 mm, notch 12 mm, eight elements in a zone E'Gc/ft²
//    ┌─────────┐
//    ├───      │
//    └─────────┘
//    ↓ ↓ ↓ ↓ ↓ ↓

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/laboratory.hpp"
#include "step/figures.hpp"
#include "validation/fracture/open_edges.hpp"

namespace yadefrag::test {
namespace {

constexpr double kWide = .03, kNotch = .012;  // m

struct Break {
  double load = 0;   ///< Pa, the largest, over the width
  double angle = 0;  ///< °, of the crack from the notch's tip to its far end
};

Break pull(const Trial& trial) {
  BodySpec spec = rock();
  spec.brittle.shearFactor = 1;
  spec.element = trial.element;
  const ElasticMaterial& m = spec.material;
  const double young = m.young / (1 - m.poisson * m.poisson), ft = spec.brittle.tensileStrength;
  spec.brittle.fractureEnergy = ft * ft * 8 * trial.size / young;
  const double slit = trial.size / 20, half = kWide / 2;
  World world;
  world.addBody(trial.mesh({{{0, -half},
                             {kWide, -half},
                             {kWide, half},
                             {0, half},
                             {0, slit},
                             {kNotch, 0},
                             {0, -slit}},
                            {}}),
                spec);
  const double crossing = kWide / std::sqrt(m.waveModulus() / m.density);
  const double duration = trial.crossings * crossing;
  // Somewhat more than it takes.
  const double speed = 3 * ft / young * std::sqrt(8 * trial.size / kNotch) * kWide / duration;
  world.dynamicsSettings.damping = 1 / crossing;
  const std::vector<NodeId> top = nodesAtHeight(world, half), bottom = nodesAtHeight(world, -half);
  const double dt = .8 * world.criticalTimeStep();
  Break outcome;
  double last = 0;
  while (world.time < 2 * duration && last >= .15 * outcome.load) {
    const double now = speed * std::min(1., world.time / (.3 * duration));
    world.prescribe(top, kHeldXY, {0, now / 2});
    world.prescribe(bottom, kHeldXY, {0, -now / 2});
    const double before = world.ledger.external;
    double way = 0;
    for (const double end = world.time + crossing / 4; world.time < end; way += now * dt)
      world.step(dt);
    if (way > 0) last = (world.ledger.external - before) / way / kWide;
    outcome.load = std::max(outcome.load, last);
  }
  Vec2 far{kNotch, 0};
  for (const OpenEdge& edge : openEdges(world))
    for (const Vec2 end : {edge.first, edge.last})
      if (end.x > far.x) far = end;
  EXPECT_GT(far.x, .85 * kWide) << "it breaks";
  outcome.angle = std::atan2(far.y, far.x - kNotch) * 180 / std::numbers::pi;
  return outcome;
}

struct Spread {
  double steepest = 0;  ///< °
  double mean = 0;      ///< °, of all angles
  double most = 0, least = INFINITY;
};

Spread pullTurned(Trial trial, const std::vector<double>& turns) {
  trial.crossings = 60;
  Spread spread;
  for (const double turned : turns) {
    trial.turned = turned;
    const Break outcome = pull(trial);
    spread.steepest = std::max(spread.steepest, std::abs(outcome.angle));
    spread.mean += outcome.angle / static_cast<double>(turns.size());
    spread.most = std::max(spread.most, outcome.load);
    spread.least = std::min(spread.least, outcome.load);
  }
  return spread;
}

/// Wanted: 3° and 3 %. Measured: 2.4° over 24 elements, 2.8 %.
TEST(TurnedPlate, CrackGoesAcross) {
  const Spread spread = pullTurned({kWide / 40}, {0, 15, 30, 45});
  figure("steepest", spread.steepest, 0, 3);
  figure("mean_angle", spread.mean, 0, 2);
  figure("most_over_least", spread.most / spread.least, 1, .03);
}

/// Over 36 elements, ten turns: 4.8°, the mean 0.8°, and the load scatters by 4.8 %. The crack goes
/// from one node to a next one, up to 30° aside, and is one or two elements beside the middle.
TEST(TurnedPlate, AllTurnsOfAFinerMesh) {
  const Spread spread = pullTurned({kWide / 60}, {0, 5, 10, 15, 20, 25, 30, 35, 40, 45});
  figure("steepest", spread.steepest, 0, 5);
  figure("mean_angle", spread.mean, 0, 2);
  figure("most_over_least", spread.most / spread.least, 1, .055);
}

}  // namespace
}  // namespace yadefrag::test
