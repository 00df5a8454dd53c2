#pragma once
// Bodies for the tests of whole steps.

#include <functional>

#include "meshing/structured.hpp"
#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

inline ElasticMaterial steel(double poisson = .3) { return {210e9, poisson, 7800, false}; }

/// A spec with a velocity for all nodes.
inline BodySpec moving(const TriangleMesh& mesh, const ElasticMaterial& material, Vec2 velocity) {
  BodySpec spec;
  spec.material = material;
  spec.velocity.assign(mesh.nodes.size(), velocity);
  return spec;
}

inline void hold(BodySpec& spec, const TriangleMesh& mesh, std::uint8_t held,
                 const std::function<bool(Vec2)>& where) {
  spec.held.resize(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (where(mesh.nodes[i])) spec.held[i] |= held;
}

inline void smoothAll(BodySpec& spec, const TriangleMesh& mesh) {
  spec.smoothNodes.assign(mesh.nodes.size(), 1);
}

inline double totalEnergy(const World& world) {
  return world.ledger.total(world.kineticEnergy(), world.strainEnergy());
}

/// Σ of a component's momentum (kg m/s).
inline Vec2 momentum(const World& world, ComponentId component) {
  Vec2 sum;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    if (world.model.nodes.component[i] == component)
      sum += world.model.nodes.mass[i] * world.model.nodes.velocity[i];
  return sum;
}

inline double mass(const World& world, ComponentId component) {
  double sum = 0;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    if (world.model.nodes.component[i] == component) sum += world.model.nodes.mass[i];
  return sum;
}

}  // namespace yadefrag::test
