#pragma once
// Two triangles left and right of the edge x = 0: all of a cohesive law, and hardly anything else.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// Two triangles whose edge has cracked in the first step, in which they have shrunk a little, and
/// what drives them from then on.
class DrivenPair {
 public:
  /// `weak`: of the strength, what the edge has until it cracks, so that little is stretched.
  DrivenPair(const BodySpec& spec, double step, double weak = 1) : dt(step) {
    addTwoTriangles(world, spec, 1.3 * weak);
    world.fracture.edges.strength[0] *= weak;
    world.step(dt);
    EXPECT_EQ(world.fracture.numCracks(), 1U);
    EXPECT_EQ(world.model.nodes.size(), 6U);
    world.fracture.edges.strength[0] /= weak;
    start_ = totalEnergy(world);
  }

  /// (m) From the left face to the right one, at an end.
  [[nodiscard]] Vec2 opening(std::size_t end) const { return openingOf(world, end); }

  /// In the next step forces give each half this velocity (m/s; the left one its opposite), and
  /// press the faces together by `pressure` (Pa).
  void drive(Vec2 speed, double pressure = 0) {
    Nodes& nodes = world.model.nodes;
    world.loads.outerForces.assign(nodes.size(), {});
    for (std::size_t element = 0; element < 2; ++element) {
      const double sign = element == 0 ? -1 : 1;
      const auto& corners = world.model.triangles.nodes[element];
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = nodes.mass[corners[i].value] / dt;
        Vec2 force = share * (sign * speed - nodes.velocity[corners[i].value]);
        // Pressed faces keep apart by themselves.
        if (pressure > 0) force.x = i == (element == 0 ? 2U : 1U) ? 0 : -sign * pressure * kHalf;
        world.loads.outerForces[corners[i].value] = force;
      }
    }
  }

  void step() {
    Vec2 push;
    for (const NodeId node : world.model.triangles.nodes[0])
      if (!world.loads.outerForces.empty()) push += world.loads.outerForces[node.value];
    const Vec2 before = leftMomentum();
    world.step(dt);
    traction = 1 / kArea * (1 / dt * (leftMomentum() - before) - push);
    worstEnergy = std::max(worstEnergy, std::abs(totalEnergy(world) - start_));
  }

  World world;
  double dt;               ///< s
  Vec2 traction;           ///< Pa, on the left half, from its momentum
  double worstEnergy = 0;  ///< J

 private:
  [[nodiscard]] Vec2 leftMomentum() const {
    Vec2 sum;
    for (const NodeId node : world.model.triangles.nodes[0])
      sum += world.model.nodes.mass[node.value] * world.model.nodes.velocity[node.value];
    return sum;
  }

  double start_ = 0;
};

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
