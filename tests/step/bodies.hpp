#pragma once
// Bodies for the tests of whole steps: brittle and plastic ones, blocks that touch exactly.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
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

/// What cracks at a strength (Pa); without a fracture energy (J/m²) at once.
inline BodySpec brittle(const ElasticMaterial& material, double strength, double energy = 0) {
  BodySpec spec;
  spec.material = material;
  spec.brittle.tensileStrength = strength;
  spec.brittle.fractureEnergy = energy;
  return spec;
}

/// A rigid line from a to b with both sides.
inline RigidSpec rigidLine(Vec2 a, Vec2 b, double friction = 0) {
  RigidSpec spec;
  spec.shape.nodes = {a, b};
  spec.shape.loops = {{0, 1}};
  spec.friction = friction;
  spec.name = "line";
  return spec;
}

inline World inPasses(int passes) {
  World world;
  world.contactSettings.passes = passes;
  return world;
}
inline World twoPasses() { return inPasses(2); }

inline ComponentId addMoving(World& world, const TriangleMesh& mesh,
                             const ElasticMaterial& material, Vec2 velocity) {
  return world.addBody(mesh, moving(mesh, material, velocity));
}

/// So many steps of a part of the critical one.
inline void stepFor(World& world, double ofCritical, int count) {
  const double dt = ofCritical * world.criticalTimeStep();
  for (int i = 0; i < count; ++i) world.step(dt);
}

inline void hold(BodySpec& spec, const TriangleMesh& mesh, std::uint8_t held,
                 const std::function<bool(Vec2)>& where) {
  spec.held.resize(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (where(mesh.nodes[i])) spec.held[i] |= held;
}

/// Sides of which both ends are there, once each.
inline std::vector<JointEdge> jointsWhere(const TriangleMesh& mesh, double strength, double energy,
                                          const std::function<bool(Vec2)>& where) {
  std::vector<JointEdge> joints;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (a < b && where(mesh.nodes[a]) && where(mesh.nodes[b]))
        joints.push_back({{a, b}, strength, energy});
    }
  return joints;
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

inline Vec2 meanVelocity(const World& world, ComponentId component) {
  return (1 / mass(world, component)) * momentum(world, component);
}

/// (N) On a body.
inline Vec2 contactForce(const World& world, ComponentId component) {
  Vec2 sum;
  for (std::size_t i = 0; i < world.model.nodes.size(); ++i)
    if (world.model.nodes.component[i] == component) sum += world.contact.forces()[i];
  return sum;
}

/// (m) The middle of a triangle in the stress-free shape.
inline Vec2 middleOf(const World& world, std::size_t triangle) {
  const auto& [a, b, c] = world.model.triangles.nodes[triangle];
  const std::vector<Vec2>& x = world.model.nodes.reference;
  return (1. / 3) * (x[a.value] + x[b.value] + x[c.value]);
}

/// Only edges crack of which both ends are there in the stress-free shape.
inline void crackOnly(World& world, const std::function<bool(Vec2)>& where) {
  CrackEdges& edges = world.fracture.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Side side = edges.side(EdgeId(i), 0);
    for (const NodeId node : {firstNode(world.model, side), lastNode(world.model, side)})
      if (!where(world.model.nodes.reference[node.value])) edges.strength[i] = INFINITY;
  }
}

/// Adds the nodal forces (N/m) of a traction (Pa) on sides of the outline with both ends there.
inline void addTraction(const TriangleMesh& mesh, Vec2 traction,
                        const std::function<bool(Vec2)>& where, std::vector<Vec2>& loads) {
  const auto& loop = mesh.loops[0];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
    if (!where(mesh.nodes[a]) || !where(mesh.nodes[b])) continue;
    for (const std::uint32_t end : {a, b})
      loads[end] += norm(mesh.nodes[b] - mesh.nodes[a]) / 2 * traction;
  }
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

// --- Blocks that touch exactly, as in masonry, jointed rock and dry stacks.

inline constexpr double kBlockSide = .1;  // m

struct BlockWall {
  int blocks;           ///< in a row, and rows
  double gap = 0;       ///< m, half the width of each joint
  double jitter = .25;  ///< of a side: how far inner corners are out of place
  double friction = .5;
};

/// Outlines of the floor, and of four-sided blocks that fill a square on it. Two neighbours have
/// their corners at the same places if the gap is 0.
inline std::vector<std::vector<Vec2>> blockOutlines(const BlockWall& wall) {
  const int count = wall.blocks + 1;
  std::mt19937_64 random(5);
  const auto some = [&] { return wall.jitter * (2 * double(random() >> 11) * 0x1p-53 - 1); };
  std::vector<Vec2> corners;
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column) {
      const bool inner = row > 0 && row < wall.blocks && column > 0 && column < wall.blocks;
      const double dx = inner ? some() : 0, dy = inner ? some() : 0;
      corners.push_back(kBlockSide * Vec2{column + dx, row + dy});
    }
  const double wide = kBlockSide * wall.blocks;
  std::vector<std::vector<Vec2>> outlines{
      {{-wide, -kBlockSide}, {2 * wide, -kBlockSide}, {2 * wide, 0}, {-wide, 0}}};
  for (int row = 0; row < wall.blocks; ++row)
    for (int column = 0; column < wall.blocks; ++column) {
      const auto at = [&](int x, int y) {
        return corners[static_cast<std::size_t>(row + y) * static_cast<std::size_t>(count) +
                       static_cast<std::size_t>(column + x)];
      };
      std::vector<Vec2> outline{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      const Vec2 middle = .25 * (outline[0] + outline[1] + outline[2] + outline[3]);
      for (Vec2& corner : outline) {
        const Vec2 inwards = middle - corner;
        corner += (wall.gap / norm(inwards)) * inwards;
      }
      outlines.push_back(std::move(outline));
    }
  return outlines;
}

/// The blocks, under gravity, on the floor, which is held. The nodes of neighbours are at the same
/// places, too.
inline void addBlockWall(World& world, const BlockWall& wall) {
  bool isFloor = true;
  for (const std::vector<Vec2>& outline : blockOutlines(wall)) {
    const TriangleMesh mesh = triangulate({outline, {}}, isFloor ? kBlockSide : kBlockSide / 2);
    BodySpec spec;
    spec.material = {30e9, .2, 2500, false};
    spec.friction = wall.friction;
    spec.selfContact = false;
    if (isFloor) spec.held.assign(mesh.nodes.size(), kHeldXY);
    world.addBody(mesh, spec);
    isFloor = false;
  }
  world.dynamicsSettings.gravity = {0, -9.81};
}

// --- Bodies for the problems with closed solutions of ideal plasticity.

/// Ideally plastic steel; k = Y/√3 is its shear strength.
inline BodySpec idealSteel(double yield = 300e6, ElementKind kind = ElementKind::kSmoothed) {
  BodySpec spec;
  spec.material = steel();
  spec.plastic.yieldStress = yield;
  spec.element = kind;
  return spec;
}

inline double shearStrength(const BodySpec& spec) {
  return spec.plastic.yieldStress / std::numbers::sqrt3;
}

/// (N/m) Mean force with which the nodes press downwards in the last fifth of the steps.
inline double meanForce(World& world, const std::vector<NodeId>& nodes, double dt, int steps) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < steps; ++i) {
    world.step(dt);
    if (i < steps * 4 / 5) continue;
    for (const NodeId n : nodes) sum -= world.reactions[n.value].y;
    ++count;
  }
  return sum / count;
}

}  // namespace yadefrag::test
