// A rigid strip footing on a weightless frictional half-space (Prandtl; Terzaghi 1943): the mean
// pressure becomes Nc·c, Nc = (e^(π tan φ) tan²(π/4 + φ/2) − 1)/tan φ. Drucker and Prager's cone is
// matched to Mohr and Coulomb in plane strain for associated flow.

#include <gtest/gtest.h>

#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kHalf = .5;  // m, half of the footing

/// Mesh of the right half, turned by `degrees` and back. It is fine at the end of the footing,
/// where the stress is singular.
TriangleMesh halfSpace(double wide, double deep, double finest, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180),
               s = std::sin(degrees * std::numbers::pi / 180);
  const auto turned = [&](Vec2 p, double by) {
    return Vec2{c * p.x - by * s * p.y, by * s * p.x + c * p.y};
  };
  Polygon half{{{0, -deep}, {wide, -deep}, {wide, 0}, {kHalf, 0}, {0, 0}}, {}};
  Vec2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (Vec2& p : half.outline) {
    p = turned(p, 1);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  constexpr double kCell = .05;
  const auto columns = static_cast<std::uint32_t>((high.x - low.x) / kCell) + 2;
  const auto rows = static_cast<std::uint32_t>((high.y - low.y) / kCell) + 2;
  const Vec2 end = turned({kHalf, 0}, 1);
  std::vector<double> sizes;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const Vec2 at = low + Vec2{i * kCell, j * kCell};
      sizes.push_back(std::min(kHalf / 5, finest + .1 * norm(at - end)));
    }
  TriangleMesh mesh =
      triangulate(half, SizeField(low, kCell, columns, sizes), {NodeLayout::kRows, 1});
  for (Vec2& p : mesh.nodes) p = turned(p, -1);
  return mesh;
}

/// Mean pressure over Nc·c.
double footing(double finest, double degrees, ElementKind kind = ElementKind::kSmoothed) {
  constexpr double kFriction = .35;  // rad
  const double wide = 6 * kHalf, deep = 4 * kHalf;
  const TriangleMesh mesh = halfSpace(wide, deep, finest, degrees);
  BodySpec spec;
  spec.material = {4e9, .3, 2000, false};
  spec.element = kind;
  spec.plastic.cohesion = 1e5;
  spec.plastic.internalFriction = spec.plastic.dilation = std::tan(kFriction);
  hold(spec, mesh, kHeldXY, [&](Vec2 x) { return x.y < -deep + 1e-9; });
  hold(spec, mesh, kHeldX, [&](Vec2 x) { return x.x < 1e-9 || x.x > wide - 1e-9; });
  World world;
  world.addBody(mesh, spec);
  const auto under = nodesWhere(world, [](Vec2 x) { return x.y > -1e-9 && x.x < kHalf * 1.0001; });
  // The damping acts against the flow: with five times its force the pressure is 0.03 higher.
  constexpr double kSpeed = .02;  // m/s
  world.prescribe(under, kHeldXY, {0, -kSpeed});
  world.dynamicsSettings.damping = 40;
  const double dt = .7 * world.criticalTimeStep();
  const double t = std::tan(kFriction), k = std::tan(std::numbers::pi / 4 + kFriction / 2);
  const double factor = (std::exp(std::numbers::pi * t) * k * k - 1) / t;
  const int steps = static_cast<int>(.0026 * kHalf / (kSpeed * dt));
  return meanForce(world, under, dt, steps) / (kHalf * factor * spec.plastic.cohesion);
}

// The error is that of the mesh at the end of the footing: it becomes less as that is refined.
TEST(StripFooting, BearingCapacity) {
  for (const double degrees : {0., 15., 30.})
    EXPECT_NEAR(footing(.03 * kHalf, degrees), 1, .05) << degrees;
  const double coarse = footing(.1 * kHalf, 0);
  EXPECT_GT(coarse, 1.05);
  EXPECT_LT(coarse, 1.12);
}

}  // namespace
}  // namespace yadefrag::test
