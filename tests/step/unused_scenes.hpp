#pragma once
// One scene with and without each of the things that a scene may use: rings within each other, as
// in the paper's figure 12, that bounce.

#include <algorithm>
#include <string>

#include "benchmark/fe_scenes.hpp"

namespace yadefrag::test {

struct Uses {
  bool fracture = false, cohesion = false, friction = false, smooth = false, selfContact = false;
  bool viscosity = false, held = false, loads = false, materials = false;

  /// Turns on what is called so; false if nothing is.
  bool turnOn(const std::string& name) {
    bool Uses::*const all[] = {&Uses::fracture,    &Uses::cohesion,  &Uses::friction,
                               &Uses::smooth,      &Uses::viscosity, &Uses::held,
                               &Uses::selfContact, &Uses::loads,     &Uses::materials};
    const char* const names[] = {"fracture", "cohesion",    "friction", "smooth",   "viscosity",
                                 "held",     "selfContact", "loads",    "materials"};
    for (std::size_t i = 0; i < std::size(all); ++i)
      if (name == names[i]) return this->*all[i] = true;
    return false;
  }
};

/// Blocks of 5 mm and cells × cells × 2 triangles, 0.1 m apart: none is ever near another.
inline void addFarBlocks(World& world, int count, int cells) {
  for (int i = 0; i < count; ++i) {
    const Vec2 low{.1 * i, 0};
    const TriangleMesh mesh = structuredRectangle(low, low + Vec2{5e-3, 5e-3}, cells, cells);
    world.addBody(mesh, fescenes::steelBody(mesh, {fescenes::kSpeed, 0}));
  }
}

inline constexpr double kRingSize = .4e-3;  // m, the triangles' edges

/// A ring, 1 mm thick.
inline TriangleMesh ringMesh(Vec2 centre, double inner) {
  Polygon ring;
  ring.outline = fescenes::circle(centre, inner + 1e-3, kRingSize);
  std::vector<Vec2> hole = fescenes::circle(centre, inner, kRingSize);
  std::reverse(hole.begin(), hole.end());
  ring.holes.push_back(hole);
  return triangulate(ring, kRingSize);
}

/// Rings with inner radii of 5 mm, 0.1 m apart, each in a direction of its own: mostly surface.
inline void addFarRings(World& world, int count) {
  std::mt19937_64 random(12);
  for (int i = 0; i < count; ++i) {
    const TriangleMesh mesh = ringMesh({.1 * i, 0}, 5e-3);
    world.addBody(mesh,
                  fescenes::steelBody(mesh, fescenes::kSpeed * fescenes::someDirection(random)));
  }
}

/// Of steel, `count` of them, 0.02 mm apart; each flies in a direction of its own.
inline void addRings(World& world, int count, const Uses& uses) {
  std::mt19937_64 random(12);
  for (int i = 0; i < count; ++i) {
    const double inner = 4e-3 + 1.02e-3 * i;
    const TriangleMesh mesh = ringMesh({}, inner);
    BodySpec spec = fescenes::steelBody(mesh, fescenes::kSpeed * fescenes::someDirection(random));
    spec.selfContact = uses.selfContact;
    if (uses.friction) spec.friction = .3;
    if (uses.smooth) spec.smoothNodes.assign(mesh.nodes.size(), 1);
    if (uses.fracture || uses.cohesion) spec.brittle.tensileStrength = 250e6;
    if (uses.cohesion) spec.brittle.fractureEnergy = 2e3;
    if (uses.materials) {
      spec.materials.materials = {spec, spec};
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        spec.materials.ofTriangle.push_back(t % 2);
    }
    if (uses.held && i == 0) spec.held.assign(mesh.nodes.size(), kHeldXY);
    world.addBody(mesh, spec);
  }
  if (uses.viscosity) world.dynamicsSettings.viscosity = {.06, 1.2};
  if (uses.loads) world.setLoads(std::vector<Vec2>(world.model.nodes.size(), {0, 1e-3}));
}

}  // namespace yadefrag::test
