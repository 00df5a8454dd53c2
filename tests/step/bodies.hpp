#pragma once
// Bodies for the tests of whole steps. A run with a record: points on the wrong side, and energy
// created.

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "mesh/shapes.hpp"
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

/// Slaves and masters that have a row, in order.
inline std::vector<SlaveMaster> activesOf(const World& world) {
  std::vector<SlaveMaster> pairs;
  for (const ContactRow& row : world.contact.rows()) pairs.push_back({row.slave, row.master});
  std::ranges::sort(pairs);
  return pairs;
}

struct RunResult {
  double deepest = 0;       ///< of the shortest segment: a boundary node in another body
  double penetration = 0;   ///< of the shortest segment: what the correction left
  double growth = 0;        ///< of the start's energy: kinetic + strain
  double drift = 0;         ///< of the start's energy: the ledger's total, either way
  std::size_t touched = 0;  ///< rows with a force, over all steps
};

/// Rubber, soft enough that blows of some m/s deform bodies visibly.
inline ElasticMaterial rubber() { return {1e7, .3, 1000, false}; }

struct BodyLoop {
  ComponentId component;
  std::vector<Vec2> points;
};

inline std::vector<BodyLoop> loopsOf(const World& world) {
  const ContactSurfaces& surfaces = world.surfaces;
  std::vector<BodyLoop> loops;
  std::vector<bool> seen(surfaces.segments(), false);
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    if (seen[s]) continue;
    loops.push_back({world.model.nodes.component[surfaces.segmentNode[s].value], {}});
    for (std::size_t at = s; !seen[at]; at = surfaces.segmentNext[at].value) {
      seen[at] = true;
      loops.back().points.push_back(world.model.nodes.position[surfaces.segmentNode[at].value]);
    }
  }
  return loops;
}

/// How often a ray from `point` to the right crosses a loop, and how far the loop is (m).
inline void lookAt(const BodyLoop& loop, Vec2 point, bool& inside, double& distance) {
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec2 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
    const Vec2 along = b - a;
    if ((a.y > point.y) != (b.y > point.y) && point.x < along.x * (point.y - a.y) / along.y + a.x)
      inside = !inside;
    const double at = std::clamp(dot(point - a, along) / dot(along, along), 0., 1.);
    distance = std::min(distance, norm(point - a - at * along));
  }
}

/// (m) How deep the deepest boundary node is in another body.
inline double deepestNode(const World& world) {
  const std::vector<BodyLoop> loops = loopsOf(world);
  double deepest = 0;
  for (const BodyLoop& from : loops)
    for (const Vec2 point : from.points)
      for (std::size_t c = 0; c < world.model.components.size(); ++c) {
        if (ComponentId(c) == from.component) continue;
        bool inside = false;
        double distance = INFINITY;
        for (const BodyLoop& loop : loops)
          if (loop.component == ComponentId(c)) lookAt(loop, point, inside, distance);
        if (inside) deepest = std::max(deepest, distance);
      }
  return deepest;
}

/// `every`: steps between two looks, which cost more than the steps.
inline RunResult watch(World& world, int steps, int every, double ofCritical = .5) {
  const double dt = ofCritical * world.criticalTimeStep();
  const double start = world.kineticEnergy() + world.strainEnergy();
  const double total = totalEnergy(world);
  RunResult result;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    result.penetration =
        std::max(result.penetration, world.contact.maxPenetration() / world.search.shortest);
    result.touched += world.contact.rows().size();
    if (i % every != 0) continue;
    result.deepest = std::max(result.deepest, deepestNode(world) / world.search.shortest);
    const double now = world.kineticEnergy() + world.strainEnergy();
    result.growth = std::max(result.growth, now / start - 1);
    result.drift = std::max(result.drift, std::abs(totalEnergy(world) / total - 1));
  }
  return result;
}

}  // namespace yadefrag::test
