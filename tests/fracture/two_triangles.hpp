#pragma once
// Two triangles left and right of the edge x = 0: all of a cohesive law, and hardly anything else.

#include <string>
#include <utility>
#include <vector>

#include "mesh/softening_curve.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {

constexpr double kStrength = 300e6, kEnergy = 100;        // Pa, J/m²
constexpr double kCritical = 2 * kEnergy / kStrength;     // m
constexpr double kHalf = 1e-4;                            // m, half the edge
constexpr double kArea = 2 * kHalf;                       // m²
constexpr ElasticMaterial kStiff{275e11, 0, 2750, true};  // it hardly stores anything

/// `spec`: what differs from this strength and energy. `stretch`: of the strength, at the start.
inline void addTwoTriangles(World& world, BodySpec spec, double stretch) {
  TriangleMesh mesh;
  mesh.nodes = {{0, -kHalf}, {0, kHalf}, {-kHalf, 0}, {kHalf, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  mesh.loops = mesh.loopVertices = {{0, 3, 1, 2}};
  spec.material = kStiff;
  spec.brittle.tensileStrength = kStrength;
  spec.brittle.fractureEnergy = kEnergy;
  for (const Vec2 x : mesh.nodes)
    spec.displacement.push_back({stretch * kStrength / kStiff.young * x.x, 0});
  world.addBody(mesh, spec);
}

/// (m) From the left face to the right one, at the edge's lower or upper end.
inline Vec2 openingOf(const World& world, std::size_t end) {
  const auto& left = world.model.triangles.nodes[0];
  const auto& right = world.model.triangles.nodes[1];
  const auto& x = world.model.nodes.position;
  return x[right[end == 0 ? 0 : 2].value] - x[left[end].value];
}

/// The named ones, and tables: a plateau before a steep fall, a step, uneven points.
inline std::vector<std::pair<std::string, SofteningCurve>> softeningCurves() {
  std::vector<std::pair<std::string, SofteningCurve>> all;
  for (const std::string_view name : softeningNames()) all.emplace_back(name, softeningNamed(name));
  all.emplace_back("plateau", SofteningCurve({{0, 1}, {.6, 1}, {1, 0}}));
  all.emplace_back("step", SofteningCurve({{0, 1}, {.1, .9}, {.2, .3}, {.7, .3}, {1, 0}}));
  all.emplace_back("uneven", SofteningCurve({{0, 1}, {.01, .8}, {.3, .25}, {.9, .2}, {1, 0}}));
  return all;
}

}  // namespace yadefrag::test
