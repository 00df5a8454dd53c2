// A rigid strip footing on a weightless frictional half-space (Prandtl; Terzaghi 1943): the mean
// pressure becomes Nc·c, Nc = (e^(π tan φ) tan²(π/4 + φ/2) − 1)/tan φ. Drucker and Prager's cone is
// matched to Mohr and Coulomb in plane strain for associated flow.

#include <gtest/gtest.h>

#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kHalf = .5;  // m, half of the footing

/// Mean pressure over Nc·c.
double footing(double finest, NodeLayout layout, double friction) {
  const double wide = 6 * kHalf, deep = 5 * kHalf;
  const Polygon half{{{0, -deep}, {wide, -deep}, {wide, 0}, {kHalf, 0}, {0, 0}}, {}};
  // Fine at the end of the footing, where the stress is singular.
  constexpr double kCell = .05;
  const auto columns = static_cast<std::uint32_t>(wide / kCell) + 2;
  const auto rows = static_cast<std::uint32_t>(deep / kCell) + 2;
  std::vector<double> sizes;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const Vec2 at{i * kCell, -deep + j * kCell};
      sizes.push_back(std::min(kHalf / 4, finest + .15 * norm(at - Vec2{kHalf, 0})));
    }
  const SizeField size({0, -deep}, kCell, columns, sizes);
  const TriangleMesh mesh = triangulate(half, size, {layout, 1});
  BodySpec spec;
  spec.material = {1e9, .3, 2000, false};
  spec.element = ElementKind::kSmoothed;
  spec.plastic.cohesion = 1e5;
  spec.plastic.internalFriction = spec.plastic.dilation = std::tan(friction);
  hold(spec, mesh, kHeldXY, [&](Vec2 x) { return x.y < -deep + 1e-9; });
  hold(spec, mesh, kHeldX, [&](Vec2 x) { return x.x < 1e-9 || x.x > wide - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const double speed = .03;  // m/s
  const auto under = nodesWhere(world, [](Vec2 x) { return x.y > -1e-9 && x.x < kHalf * 1.0001; });
  world.prescribe(under, kHeldXY, {0, -speed});
  world.dynamicsSettings.damping = 100;
  const double dt = .7 * world.criticalTimeStep();
  const double t = std::tan(friction), k = std::tan(std::numbers::pi / 4 + friction / 2);
  const double factor = (std::exp(std::numbers::pi * t) * k * k - 1) / t;
  const int steps = static_cast<int>(.015 * kHalf / (speed * dt));
  return meanForce(world, under, dt, steps) / (kHalf * factor * spec.plastic.cohesion);
}

// With twice the triangles along each side, 4588, it is 1.08.
TEST(StripFooting, BearingCapacity) {
  EXPECT_NEAR(footing(kHalf / 10, NodeLayout::kRows, .35), 1, .15);
}

}  // namespace
}  // namespace yadefrag::test
