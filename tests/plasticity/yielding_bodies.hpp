#pragma once
// Bodies for the problems with closed solutions of ideal plasticity.

#include <cmath>
#include <numbers>

#include "step/bodies.hpp"

namespace yadefrag::test {

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

/// The mesh of the outline turned by `degrees`, turned back.
inline TriangleMesh turnedMesh(Polygon polygon, double size, double degrees,
                               MeshLayout layout = {}) {
  const double c = std::cos(degrees * std::numbers::pi / 180),
               s = std::sin(degrees * std::numbers::pi / 180);
  const auto turn = [&](std::vector<Vec2>& points, double by) {
    for (Vec2& p : points) p = Vec2{c * p.x - by * s * p.y, by * s * p.x + c * p.y};
  };
  turn(polygon.outline, 1);
  for (auto& hole : polygon.holes) turn(hole, 1);
  TriangleMesh mesh = triangulate(polygon, size, layout);
  turn(mesh.nodes, -1);
  return mesh;
}

inline std::vector<NodeId> nodesWhere(const World& world, const std::function<bool(Vec2)>& where) {
  std::vector<NodeId> found;
  for (std::size_t n = 0; n < world.model.nodes.size(); ++n)
    if (where(world.model.nodes.reference[n])) found.emplace_back(n);
  return found;
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
