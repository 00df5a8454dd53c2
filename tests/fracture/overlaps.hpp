#pragma once
// How deep the deepest node is inside another piece or its own: everything against everything,
// independently of surfaces, slaves, masters or flags. Tips that pass each other may overlap
// without a node of either inside the other: deepestOverlap of lib. A run with a record: points on
// the wrong side, and energy created. An elastic cylinder on a brittle block (fig. 15 of the paper,
// small), and what is measured while the block falls to pieces.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/checks.hpp"
#include "core/disjoint_sets.hpp"
#include "fracture/random_cracks.hpp"
#include "step/bodies.hpp"
#include "step/overlap_check.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

inline double distanceToSide(Vec2 point, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double at = std::clamp(dot(point - a, along) / dot(along, along), 0., 1.);
  return norm(point - a - at * along);
}

class Overlaps {
 public:
  explicit Overlaps(const Model& model)
      : model_(model), piece_(piecesOf(model)), sides_(boundarySides(model)) {
    onBoundary_.resize(model.nodes.size());
    for (const Side side : sides_) onBoundary_[firstNode(model, side).value] = true;
  }

  /// (m) Of any boundary node that is inside a triangle which is not its own.
  [[nodiscard]] double deepest() const {
    std::vector<NodeId> nodes;  // by x
    for (std::size_t n = 0; n < onBoundary_.size(); ++n)
      if (onBoundary_[n]) nodes.emplace_back(n);
    const auto x = [&](NodeId node) { return at(node).x; };
    std::ranges::sort(nodes, {}, x);
    double worst = 0;
    for (std::uint32_t e = 0; e < piece_.size(); ++e) {
      const auto& c = model_.triangles.nodes[e];
      const auto [low, high] = std::minmax({at(c[0]).x, at(c[1]).x, at(c[2]).x});
      for (auto i = std::ranges::lower_bound(nodes, low, {}, x); i != nodes.end() && x(*i) <= high;
           ++i)
        if (std::ranges::find(c, *i) == c.end() && isIn(at(*i), c))
          worst = std::max(worst, depthIn(piece_[e], *i));
    }
    return worst;
  }

 private:
  [[nodiscard]] Vec2 at(NodeId node) const { return model_.nodes.position[node.value]; }
  [[nodiscard]] bool isIn(Vec2 point, const std::array<NodeId, 3>& c) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = at(c[k]), b = at(c[(k + 1) % 3]);
      if (cross(b - a, point - a) <= 0) return false;
    }
    return true;
  }
  /// To the piece's surface; the node's own sides are none that it could have passed.
  [[nodiscard]] double depthIn(std::uint32_t piece, NodeId node) const {
    double least = INFINITY;
    for (const Side side : sides_) {
      if (piece_[side.element.value] != piece) continue;
      const NodeId a = firstNode(model_, side), b = lastNode(model_, side);
      if (a != node && b != node) least = std::min(least, distanceToSide(at(node), at(a), at(b)));
    }
    return least;
  }

  const Model& model_;
  std::vector<std::uint32_t> piece_;
  std::vector<Side> sides_;
  std::vector<bool> onBoundary_;
};

/// (m) How deep the deepest boundary node is in another body or its own.
inline double deepestNode(const World& world) { return Overlaps(world.model).deepest(); }

struct RunResult {
  double deepest = 0;       ///< of the shortest segment: a boundary node in a body
  double penetration = 0;   ///< of the shortest segment: what the correction left
  double growth = 0;        ///< of the start's energy: kinetic + strain
  double drift = 0;         ///< of the start's energy: the ledger's total, either way
  std::size_t touched = 0;  ///< rows with a force, over all steps
};

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

/// (m) Shortest boundary segment of the stress-free bodies, faces of cracks included.
inline double shortestSide(const World& world) {
  double least = INFINITY;
  for (const Side side : boundarySides(world.model))
    least = std::min(least, norm(world.model.nodes.reference[lastNode(world.model, side).value] -
                                 world.model.nodes.reference[firstNode(world.model, side).value]));
  return least;
}

/// (m²) Their areas.
inline std::vector<double> wholePieces(const World& world) {
  const CrackEdges& edges = world.fracture.edges;
  const std::vector<double>& areas = world.model.triangles.area;
  DisjointSets pieces(areas.size());
  const auto join = [&](EdgeId edge) {
    const auto [a, b] = edges.element[edge.value];
    pieces.join(a.value, b.value);
  };
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges.cracked[i] == 0) join(EdgeId(i));
  for (const EdgeId edge : world.fracture.cohesion.edge) join(edge);
  std::vector<double> sums(areas.size());
  for (std::uint32_t e = 0; e < areas.size(); ++e) sums[pieces.find(e)] += areas[e];
  std::erase(sums, 0);
  return sums;
}

struct ImpactSetting {
  double size = 1e-3;          // m
  double fractureEnergy = 0;   // J/m²
  double speed = 100;          // m/s
  bool held = true;            // the block, at its bottom
  int steps = 500, every = 5;  // steps between two looks at all overlaps
  NodeLayout nodes = NodeLayout::kRows;
  tolerance::Contact constants = {};
};

struct ImpactResult {
  double growth = 0;     ///< of the number of segments
  double deepest = 0;    ///< of the shortest segment: a node in another piece or its own
  double triangles = 0;  ///< the same of two triangles, which may cross without a node in either
  double drift = 0;      ///< of the start's energy: the ledger's total, either way
  double massError = 0, momentumError = 0;
  double contact = 0, fracture = 0;  ///< of the start's energy
  double given = 0;  ///< of it, the sum of what contact gave in steps in which it did
  std::uint64_t cracks = 0;
};

inline World impact(const ImpactSetting& setting) {
  constexpr double kWidth = 20e-3, kHeight = 10e-3, kRadius = 5e-3;  // m
  World world = twoPasses();
  world.contactSettings.constants = setting.constants;
  const TriangleMesh block = triangulate({box({-kWidth / 2, -kHeight}, {kWidth / 2, 0}), {}},
                                         setting.size, {setting.nodes});
  BodySpec ceramic = brittle({370e9, .22, 3900, false}, 300e6, setting.fractureEnergy);
  ceramic.brittle.strengthScatter = .1;
  ceramic.friction = .3;
  if (setting.held) hold(ceramic, block, kHeldXY, [](Vec2 at) { return at.y < -kHeight + 1e-9; });
  world.addBody(block, ceramic);
  const int corners = static_cast<int>(2 * std::numbers::pi * kRadius / setting.size);
  const TriangleMesh cylinder =
      triangulate({circle({1e-4, 1.001 * kRadius}, kRadius, corners), {}}, setting.size);
  BodySpec metal = moving(cylinder, steel(), {0, -setting.speed});
  metal.friction = .3;
  world.addBody(cylinder, metal);
  return world;
}

inline ImpactResult runImpact(const ImpactSetting& setting) {
  World world = impact(setting);
  const double dt = .8 * world.criticalTimeStep();
  const double energy = world.kineticEnergy();
  const auto segments = static_cast<double>(world.surfaces.segments());
  const Sums start = sumsOf(world.model);
  ImpactResult result;
  for (int i = 0; i < setting.steps; ++i) {
    const double taken = world.ledger.contact;
    world.step(dt);
    result.given += std::max(0., taken - world.ledger.contact) / energy;
    result.drift = std::max(result.drift, std::abs(totalEnergy(world) / energy - 1));
    const Sums sums = sumsOf(world.model);
    result.massError = std::max(result.massError, std::abs(sums.mass / start.mass - 1));
    result.momentumError =
        std::max(result.momentumError, norm(sums.momentum - start.momentum) / norm(start.momentum));
    if (i % setting.every != 0) continue;
    const double shortest = shortestSide(world);
    result.deepest = std::max(result.deepest, Overlaps(world.model).deepest() / shortest);
    result.triangles = std::max(result.triangles, deepestOverlap(world.model) / shortest);
  }
  result.growth = static_cast<double>(world.surfaces.segments()) / segments;
  result.contact = world.ledger.contact / energy;
  result.fracture = world.ledger.fracture / energy;
  result.cracks = world.fracture.numCracks();
  checkLaws(world.model, world.fracture.edges, world.surfaces);
  return result;
}

}  // namespace yadefrag::test
