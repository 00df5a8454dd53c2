#pragma once
// Elastic bodies in contact: the scenes of the paper's figures 11 and 12 and an impact, with
// meshes. Lengths in mm of steel.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "mesh/shapes.hpp"
#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::fescenes {

inline constexpr double kSpeed = 20;  // m/s

inline BodySpec steelBody(const TriangleMesh& mesh, Vec2 velocity) {
  BodySpec spec;
  spec.material = {210e9, .3, 7800, false};
  spec.selfContact = false;
  spec.velocity.assign(mesh.nodes.size(), velocity);
  return spec;
}

inline Vec2 someDirection(std::mt19937_64& random) {
  const double angle = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  return {std::cos(angle), std::sin(angle)};
}

/// With edges of about this size.
inline test::Loop circle(Vec2 centre, double radius, double size) {
  return test::circle(centre, radius,
                      static_cast<int>(std::lround(2 * std::numbers::pi * radius / size)));
}

/// Fig. 12: concentric rings, 1 mm thick, 0.1 mm apart, two and a half triangles thick; each starts
/// in a direction of its own.
inline void addRings(World& world, int count, bool smooth) {
  constexpr double kInnermost = 4e-3, kThickness = 1e-3, kGap = .1e-3, kSize = .4e-3;
  std::mt19937_64 random(12);
  for (int i = 0; i < count; ++i) {
    const double inner = kInnermost + i * (kThickness + kGap);
    Polygon ring;
    ring.outline = circle({}, inner + kThickness, kSize);
    ring.holes.push_back(circle({}, inner, kSize));
    const TriangleMesh mesh = triangulate(ring, kSize);
    BodySpec spec = steelBody(mesh, kSpeed * someDirection(random));
    if (smooth) spec.smoothNodes.assign(mesh.nodes.size(), 1);
    world.addBody(mesh, spec);
  }
}

/// Fig. 11: n × n squares of 1 mm and 8 × 8 × 2 triangles in a frame that is held, 0.1 mm apart; a
/// quarter of them moves.
inline void addSquares(World& world, int n) {
  constexpr double kEdge = 1e-3, kGap = .1e-3, kPitch = kEdge + kGap, kWall = .5e-3;
  constexpr int kCells = 8;
  std::mt19937_64 random(11);
  std::vector<Vec2> velocities(static_cast<std::size_t>(n * n));
  for (std::size_t i = 0; i < velocities.size() / 4; ++i)
    velocities[i] = kSpeed * someDirection(random);
  std::shuffle(velocities.begin(), velocities.end(), random);
  for (int k = 0; k < n * n; ++k) {
    const int column = k % n, row = k / n;
    const Vec2 low{kGap + kPitch * column, kGap + kPitch * row};
    const TriangleMesh mesh = structuredRectangle(low, low + Vec2{kEdge, kEdge}, kCells, kCells);
    world.addBody(mesh, steelBody(mesh, velocities[static_cast<std::size_t>(k)]));
  }
  const double inside = kPitch * n + kGap, far = inside + kWall;
  const Polygon frame{test::box({-kWall, -kWall}, {far, far}),
                      {test::box({0, 0}, {inside, inside})}};
  const TriangleMesh mesh = triangulate(frame, .3e-3);
  BodySpec spec = steelBody(mesh, {});
  spec.held.assign(mesh.nodes.size(), kHeldXY);
  world.addBody(mesh, spec);
}

struct Impact {
  double size;                                       ///< m, of the triangles' edges
  double radius = 5e-3, wide = 40e-3, high = 20e-3;  ///< m, of the cylinder; of the block
  double speed = kSpeed;                             ///< m/s
  bool smooth = false;                               ///< the cylinder
  double fractureEnergy = NAN;                       ///< J/m², if the block is of a ceramic
};

/// A cylinder falls on a block whose lower side is held.
inline void addImpact(World& world, const Impact& impact) {
  const TriangleMesh block = triangulate(
      test::rectangle({-impact.wide / 2, -impact.high}, {impact.wide / 2, 0}), impact.size);
  BodySpec spec = steelBody(block, {});
  if (!std::isnan(impact.fractureEnergy)) {
    spec.material = {370e9, .22, 3900, false};
    spec.brittle.tensileStrength = 300e6;
    spec.brittle.fractureEnergy = impact.fractureEnergy;
    spec.brittle.strengthScatter = .1;
    spec.brittle.seed = 1;
    spec.friction = std::tan(.3);
  }
  for (const Vec2 x : block.nodes) spec.held.push_back(x.y < -impact.high + 1e-9 ? kHeldXY : kFree);
  world.addBody(block, spec);
  const TriangleMesh cylinder = triangulate(
      {circle({0, impact.radius * 1.001}, impact.radius, impact.size), {}}, impact.size);
  BodySpec steel = steelBody(cylinder, {0, -impact.speed});
  if (impact.smooth) steel.smoothNodes.assign(cylinder.nodes.size(), 1);
  world.addBody(cylinder, steel);
}

}  // namespace yadefrag::fescenes
