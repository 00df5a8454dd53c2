#pragma once
// An elastic cylinder on a brittle block (fig. 15 of the paper, small), and what is measured while
// the block falls to pieces.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fracture/overlaps.hpp"
#include "step/bodies.hpp"
#include "step/figures.hpp"

namespace yadefrag::test {

struct ImpactSetting {
  double size = 1e-3;          // m
  double fractureEnergy = 0;   // J/m²
  double speed = 100;          // m/s
  bool held = true;            // the block, at its bottom
  int steps = 500, every = 5;  // steps between two looks at all overlaps
  int threads = 1;
  NodeLayout nodes = NodeLayout::kRows;
  tolerance::Contact constants = {};
};

struct ImpactResult {
  double growth = 0;     ///< of the number of segments
  double deepest = 0;    ///< of the shortest segment: a node in another piece or its own
  double triangles = 0;  ///< the same of two triangles, which may cross without a node in either
  double mostDeep = 0;   ///< part of the boundary nodes deeper than a thousandth of it, at any time
  double drift = 0;      ///< of the start's energy: the ledger's total, either way
  double massError = 0, momentumError = 0;
  double contact = 0, fracture = 0;  ///< of the start's energy
  double given = 0;  ///< of it, the sum of what contact gave in steps in which it did
  std::uint64_t cracks = 0;
  Nodes nodes;
};

inline World impact(const ImpactSetting& setting) {
  constexpr double kWidth = 20e-3, kHeight = 10e-3, kRadius = 5e-3;  // m
  World world;
  world.contactSettings.passes = 2;
  world.contactSettings.constants = setting.constants;
  world.threads = setting.threads;
  const TriangleMesh block = triangulate({box({-kWidth / 2, -kHeight}, {kWidth / 2, 0}), {}},
                                         setting.size, {setting.nodes});
  BodySpec ceramic = moving(block, {370e9, .22, 3900, false}, {0, 0});
  ceramic.brittle.tensileStrength = 300e6;
  ceramic.brittle.fractureEnergy = setting.fractureEnergy;
  ceramic.brittle.strengthScatter = .1;
  ceramic.friction = .3;
  if (setting.held) hold(ceramic, block, kHeldXY, [](Vec2 at) { return at.y < -kHeight + 1e-9; });
  world.addBody(block, ceramic);
  const int corners = static_cast<int>(2 * std::numbers::pi * kRadius / setting.size);
  const TriangleMesh cylinder =
      triangulate({circle({1e-4, 1.001 * kRadius}, kRadius, corners), {}}, setting.size);
  BodySpec metal = moving(cylinder, steel(), {0, -setting.speed});
  metal.friction = .3;
  world.addBody(cylinder, metal);
  return world;
}

inline ImpactResult runImpact(const ImpactSetting& setting) {
  World world = impact(setting);
  const double dt = .8 * world.criticalTimeStep();
  const double energy = world.kineticEnergy();
  const auto segments = static_cast<double>(world.surfaces.segments());
  const Sums start = sumsOf(world.model);
  ImpactResult result;
  for (int i = 0; i < setting.steps; ++i) {
    const double taken = world.ledger.contact;
    world.step(dt);
    result.given += std::max(0., taken - world.ledger.contact) / energy;
    result.drift = std::max(result.drift, std::abs(totalEnergy(world) / energy - 1));
    const Sums sums = sumsOf(world.model);
    result.massError = std::max(result.massError, std::abs(sums.mass / start.mass - 1));
    result.momentumError =
        std::max(result.momentumError, norm(sums.momentum - start.momentum) / norm(start.momentum));
    if (i % setting.every != 0) continue;
    const Overlaps overlaps(world.model);
    const double shortest = shortestSide(world);
    result.deepest = std::max(result.deepest, overlaps.deepest().depth / shortest);
    result.triangles = std::max(result.triangles, overlaps.deepestTriangles() / shortest);
    result.mostDeep = std::max(result.mostDeep, overlaps.partDeeperThan(1e-3 * shortest));
  }
  result.growth = static_cast<double>(world.surfaces.segments()) / segments;
  result.contact = world.ledger.contact / energy;
  result.fracture = world.ledger.fracture / energy;
  result.cracks = world.fracture.numCracks();
  result.nodes = world.model.nodes;
  checkLaws(world.model, world.fracture.edges, world.surfaces);
  return result;
}

}  // namespace yadefrag::test
