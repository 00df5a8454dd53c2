// Waves of uniaxial strain in an ideally plastic plate (e.g. Meyers 1994, Dynamic Behavior of
// Materials, ch. 3 and 7): an elastic wave of √((κ + 4μ/3)/ρ) up to the Hugoniot elastic limit
// Y (κ + 4μ/3)/(2μ), followed by a plastic one of √(κ/ρ). The release begins with an elastic wave
// of 2Y (κ + 4μ/3)/(2μ).

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/element_state.hpp"
#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kLength = 48e-3, kSize = .1e-3;

/// A strip that can only be compressed along x; its left end is moved at `speed`.
struct Strip {
  World world;
  BodySpec spec = idealSteel(1e9);
  double dt = 0;
  std::vector<NodeId> left;

  Strip(double speed, NodeLayout layout) {
    const double high = 3 * kSize;
    const Polygon polygon{{{0, 0}, {kLength, 0}, {kLength, high}, {0, high}}, {}};
    const TriangleMesh mesh = triangulate(polygon, kSize, {layout, 1});
    hold(spec, mesh, kHeldY, [](Vec2) { return true; });
    world.addBody(mesh, spec);
    left = nodesWhere(world, [](Vec2 x) { return x.x < 1e-9; });
    world.prescribe(left, kHeldXY, {speed, 0});
    world.dynamicsSettings.viscosity = {.06, 1.2};
    dt = .8 * world.criticalTimeStep();
  }
  void run(double until) {
    while (world.time < until) world.step(dt);
  }
  /// (Pa) −σxx, mean of the triangles around x (m, in the undeformed strip).
  [[nodiscard]] double stressAt(double x) const {
    const auto all = stresses(world.model, dt);
    double sum = 0;
    int count = 0;
    for (std::size_t e = 0; e < all.size(); ++e) {
      double middle = 0;
      for (const NodeId n : world.model.triangles.nodes[e])
        middle += world.model.nodes.reference[n.value].x / 3;
      if (std::abs(middle - x) < 2 * kSize) sum -= all[e][0], ++count;
    }
    return sum / count;
  }
  /// (m) The farthest place, in the undeformed strip, where the stress is above `level`.
  [[nodiscard]] double frontOf(double level) const {
    const auto all = stresses(world.model, dt);
    double front = 0;
    for (std::size_t e = 0; e < all.size(); ++e)
      if (-all[e][0] > level)
        for (const NodeId n : world.model.triangles.nodes[e])
          front = std::max(front, world.model.nodes.reference[n.value].x);
    return front;
  }
};

/// Speeds relative to theory.
void check(NodeLayout layout) {
  constexpr double kSpeed = 60;  // m/s
  Strip strip(kSpeed, layout);
  const SolidModuli m(strip.spec.material);
  const double wave = m.bulk + 4 * m.shear / 3, density = strip.spec.material.density;
  const double limit = strip.spec.plastic.yieldStress * wave / (2 * m.shear);
  const double elastic = std::sqrt(wave / density), plastic = std::sqrt(m.bulk / density);
  strip.run(4e-6);
  const double a1 = strip.frontOf(limit / 2), p1 = strip.frontOf(1.25 * limit);
  strip.run(7e-6);
  const double a2 = strip.frontOf(limit / 2), p2 = strip.frontOf(1.25 * limit);
  EXPECT_NEAR((a2 - a1) / 3e-6 / elastic, 1, .02);
  EXPECT_NEAR((p2 - p1) / 3e-6 / plastic, 1, .02);
  EXPECT_NEAR(strip.stressAt((a2 + p2) / 2) / limit, 1, .01);
  // Behind both waves: Σ ρ c Δv.
  const double first = limit / density / elastic;
  const double behind = density * (elastic * first + plastic * (kSpeed - first));
  EXPECT_NEAR(strip.stressAt(5e-3) / behind, 1, .01);
  // Release: the left end stops.
  strip.world.prescribe(strip.left, kHeldXY, {0, 0});
  const auto releasedTo = [&] {
    double x = 2 * kSize;
    while (strip.stressAt(x) < behind - limit) x += kSize;
    return x;
  };
  strip.run(8e-6);
  const double r1 = releasedTo();
  strip.run(9.5e-6);
  EXPECT_NEAR((releasedTo() - r1) / 1.5e-6 / elastic, 1, .02);
}

TEST(PlateImpact, ElasticLimitAndSpeedsOnARegularMesh) { check(NodeLayout::kRows); }
TEST(PlateImpact, ElasticLimitAndSpeedsOnAnIrregularMesh) { check(NodeLayout::kScattered); }

}  // namespace
}  // namespace yadefrag::test
