// A cantilever of ideally plastic steel with a mass at its tip that is struck (Parkes 1955, Proc.
// R. Soc. A 228, 462; rigid-plastic, small deflections, plane strain). A plastic hinge runs from
// the tip to the root, then the beam turns about its root. With the beam's mass per length m, the
// tip's mass G and velocity V, the plastic moment Mp and β = m/2G:
//   while the hinge is at z from the tip: the momentum (G + mz/2) v = G V and, about the tip,
//   m v z²/6 = Mp t; the tip moves by ∫ v dt = mV²/(6 Mp β²) (log U − ½ + 1/(2U²)), U = 1 + βL;
//   then the beam turns about its root by the energy that is left over Mp, with the velocity V/U of
//   the tip at first.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plasticity/yielding_bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr double kLength = 50e-3, kHeight = 5e-3, kYield = 100e6, kSpeed = 8.5;  // m, m, Pa, m/s
constexpr double kTip = 5e-3, kRatio = 3;  // m, length of the tip mass; its mass over the beam's

double plasticMoment() { return 2 / std::numbers::sqrt3 * kYield * kHeight * kHeight / 4; }

/// (rad) The tip's deflection over its distance from the root. `line`: kg/m.
double theory(double mass, double line) {
  const double arm = kLength + kTip / 2, beta = line / (2 * mass), u = 1 + beta * kLength;
  const double running = line * kSpeed * kSpeed / (6 * plasticMoment() * beta * beta) *
                         (std::log(u) - .5 + 1 / (2 * u * u));
  const double inertia = mass * arm * arm + line * std::pow(kLength, 3) / 3;
  const double spin = kSpeed / u / arm;
  return running / arm + inertia * spin * spin / (2 * plasticMoment());
}

double tipAngle(const World& world) {
  Vec2 at, from;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (world.model.nodes.component[n].value == 1)
      at += world.model.nodes.position[n], from += world.model.nodes.reference[n];
  return std::atan2((from - at).y, at.x);
}

/// The mean while the beam vibrates elastically at the end.
double angleAtRest(double degrees, double size) {
  World world;
  const Polygon beam{{{0, 0}, {kLength, 0}, {kLength, kHeight}, {0, kHeight}}, {}};
  const TriangleMesh mesh = turnedMesh(beam, size, degrees);
  BodySpec spec = idealSteel(kYield);
  hold(spec, mesh, kHeldXY, [](Vec2 x) { return x.x < 1e-9; });
  world.addBody(mesh, spec);
  const TriangleMesh block = structuredRectangle({kLength, 0}, {kLength + kTip, kHeight}, 2, 2);
  BodySpec tip = moving(block, steel(), {0, -kSpeed});
  tip.material.density = kRatio * spec.material.density * kLength / kTip;
  world.addBody(block, tip);
  world.bond(ComponentId(0), ComponentId(1), 1e10, 1e9);
  const double dt = .8 * world.criticalTimeStep();
  const double mass = kRatio * spec.material.density * kLength * kHeight;
  const double until = 1.6 * mass * kSpeed * kLength / plasticMoment();
  double sum = 0;
  int count = 0;
  while (world.time < until) {
    world.step(dt);
    if (world.time > .65 * until) sum += tipAngle(world), ++count;
  }
  return sum / count;
}

TEST(Parkes, StruckCantilever) {
  const double line = steel().density * kHeight;
  const double exact = theory(kRatio * line * kLength, line);
  for (const double degrees : {0., 15., 30.})
    EXPECT_NEAR(angleAtRest(degrees, 1.25e-3) / exact, 1, .1);
  EXPECT_NEAR(angleAtRest(0, .8e-3) / exact, 1, .05);
}

}  // namespace
}  // namespace yadefrag::test
