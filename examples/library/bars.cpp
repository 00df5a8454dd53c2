// A steel bar hits another one at rest: the library without YADE. Without lateral motion a wave
// propagates through both at c = sqrt(E/rho); after 2L/c they separate, and have exchanged their
// speeds.

#include <cmath>
#include <cstdio>

#include "meshing/triangulate.hpp"
#include "step/world.hpp"

using namespace yadefrag;

ComponentId addBar(World& world, double begin, double end, double speed) {
  const TriangleMesh mesh =
      structuredRectangle({begin, 0}, {end, .004}, 100, 4, QuadPattern::kUnionJack);
  BodySpec bar;
  bar.material = {210e9, 0, 7800, false};  // Young's modulus (Pa), Poisson's ratio, density (kg/m3)
  bar.velocity.assign(mesh.nodes.size(), {speed, 0});
  bar.held.assign(mesh.nodes.size(), kHeldY);
  return world.addBody(mesh, bar);
}

double meanSpeed(const World& world, ComponentId body) {
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i) {
    if (world.model.nodes.component[i] != body) continue;
    momentum += world.model.nodes.mass[i] * world.model.nodes.velocity[i].x;
    mass += world.model.nodes.mass[i];
  }
  return momentum / mass;
}

int main() {
  World world;
  const ComponentId left = addBar(world, 0, .1, 10), right = addBar(world, .1001, .2001, 0);
  const double end = 1e-5 + 2.5 * .1 / std::sqrt(210e9 / 7800);  // s: the gap, and more than 2L/c
  for (const double dt = .8 * world.criticalTimeStep(); world.time < end;) world.step(dt);
  std::printf("after %.1f us: left %.3f m/s, right %.3f m/s\n", 1e6 * world.time,
              meanSpeed(world, left), meanSpeed(world, right));
}
