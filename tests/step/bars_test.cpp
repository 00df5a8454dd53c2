// Bars that meet head on: the one contact problem with a closed form for all of its course.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

/// A bar along x, its lateral faces kept from bulging.
BodySpec bar(const TriangleMesh& mesh, const ElasticMaterial& material, double speed,
             double height) {
  BodySpec spec = moving(mesh, material, {speed, 0});
  hold(spec, mesh, kHeldY, [&](Vec2 at) { return at.y < 1e-9 || at.y > height - 1e-9; });
  return spec;
}

struct Impact {
  std::vector<double> force;  // N/m², mean contact stress by step
  double dt = 0;
  double energyBefore = 0, energyAfter = 0;
};

/// Steps until `until` and records the stress on component `on`.
Impact run(World& world, ComponentId on, double height, double until, double ofCritical = .8) {
  Impact impact;
  impact.dt = ofCritical * world.criticalTimeStep();
  impact.energyBefore = totalEnergy(world);
  while (world.time < until) {
    world.step(impact.dt);
    double sum = 0;
    for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
      if (world.model.nodes.component[i] == on) sum += world.contact.forces()[i].x;
    impact.force.push_back(std::abs(sum) / height);
  }
  impact.energyAfter = totalEnergy(world);
  return impact;
}

TEST(Bars, EqualBarsExchangeTheirVelocities) {
  const double length = .1, height = .004, v = 1;
  const ElasticMaterial material = steel(0);
  const double c = std::sqrt(material.waveModulus() / material.density);
  World world;
  const TriangleMesh left = structuredRectangle({0, 0}, {length, height}, 100, 4);
  const TriangleMesh right = structuredRectangle({length, 0}, {2 * length, height}, 100, 4);
  const ComponentId a = world.addBody(left, bar(left, material, v / 2, height));
  const ComponentId b = world.addBody(right, bar(right, material, -v / 2, height));
  const Impact impact = run(world, b, height, 3 * length / c);

  const double expected = material.density * c * v / 2;
  std::vector<double> plateau;
  double lasted = 0;
  for (std::size_t i = 0; i < impact.force.size(); ++i) {
    const double t = static_cast<double>(i) * impact.dt * c / length;
    if (t > .5 && t < 1.5) plateau.push_back(impact.force[i] / expected);
    if (impact.force[i] > expected / 2) lasted = t;
  }
  const double mean =
      std::accumulate(plateau.begin(), plateau.end(), 0.) / static_cast<double>(plateau.size());
  const auto [least, most] = std::minmax_element(plateau.begin(), plateau.end());
  printf("mean %.5f ripple %.4f %.4f lasted %.4f va %.4f vb %.4f energy %.3e\n", mean, *least, *most,
         lasted, momentum(world, a).x / mass(world, a), momentum(world, b).x / mass(world, b),
         impact.energyAfter / impact.energyBefore - 1);
  EXPECT_NEAR(mean, 1, .005);
}

}  // namespace
}  // namespace yadefrag::test
