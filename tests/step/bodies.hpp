#pragma once
// Bodies for the tests of whole steps.

#include <algorithm>
#include <functional>
#include <vector>

#include "mesh/shapes.hpp"
#include "meshing/structured.hpp"
#include "meshing/triangulate.hpp"
#include "step/energy_watch.hpp"
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

/// The mesh of the outline turned by `degrees`, turned back: whatever the mesher prefers points
/// elsewhere.
inline TriangleMesh turnedMesh(Polygon polygon, const SizeField& size, double degrees,
                               MeshLayout layout = {}) {
  const double angle = degrees * std::numbers::pi / 180;
  polygon.outline = turnedLoop(polygon.outline, angle);
  for (Loop& hole : polygon.holes) hole = turnedLoop(hole, angle);
  TriangleMesh mesh = triangulate(polygon, size, layout);
  mesh.nodes = turnedLoop(mesh.nodes, -angle);
  return mesh;
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

/// A crack as a line of the stress-free shape.
struct CrackLine {
  EdgeId edge;
  Vec2 first, last;  // m
  [[nodiscard]] Vec2 middle() const { return .5 * (first + last); }
};

/// `open`: only those that hold nothing any more.
inline std::vector<CrackLine> cracksOf(const World& world, bool open = false) {
  const CrackEdges& edges = world.fracture.edges;
  const auto& holding = world.fracture.cohesion.edge;
  const std::vector<Vec2>& at = world.model.nodes.reference;
  std::vector<CrackLine> cracks;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgeId edge(i);
    if (edges.cracked[i] == 0) continue;
    if (open && std::ranges::find(holding, edge) != holding.end()) continue;
    const Side side = edges.side(edge, 0);
    cracks.push_back(
        {edge, at[firstNode(world.model, side).value], at[lastNode(world.model, side).value]});
  }
  return cracks;
}

/// Step 7 at .5 s, of .1 s, without penetration; the shortest segment 1 m, the halo .5 m.
inline WatchedStep stepOf(const EnergyLedger& ledger) { return {7, .5, .1, 0, 1, .5, ledger}; }

}  // namespace yadefrag::test
