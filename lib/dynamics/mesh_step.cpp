#include "dynamics/mesh_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tolerances/mesh.hpp"
#include "dynamics/critical_time_step.hpp"
#include "mesh/assembly.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
namespace {

struct Shape {
  Vec2 centre;
  double shortest = 0;  // m, shortest side
  double altitude = 0;  // m, onto the longest side
};

Shape shapeOf(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec2 a = mesh.nodes[t[0]], b = mesh.nodes[t[1]], c = mesh.nodes[t[2]];
  const double ab = norm(b - a), bc = norm(c - b), ca = norm(a - c);
  return {(a + b + c) * (1. / 3), std::min({ab, bc, ca}),
          2 * areaOf(a, b, c) / std::max({ab, bc, ca})};
}

}  // namespace

TriangleMesh stressFreeMesh(const Model& model, ComponentId component) {
  const Component& body = model.components[component.value];
  TriangleMesh mesh;
  std::vector<std::uint32_t> numberOf(model.nodes.size(), NodeId::none().value);
  for (std::size_t t = body.firstTriangle; t < body.lastTriangle; ++t) {
    if (model.triangles.isDropped(t)) continue;
    auto& corners = mesh.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t node = model.triangles.nodes[t][k].value;
      if (numberOf[node] == NodeId::none().value) {
        numberOf[node] = static_cast<std::uint32_t>(mesh.nodes.size());
        mesh.nodes.push_back(model.nodes.reference[node]);
      }
      corners[k] = numberOf[node];
    }
  }
  return mesh;
}

double meshTimeStep(const TriangleMesh& mesh, const Component& component) {
  Model model;
  appendBody(model, mesh, component);
  return criticalTimeStep(model);
}

double latticeTimeStep(const Component& component, double side) {
  TriangleMesh mesh;
  mesh.nodes = {{0, 0}, {side, 0}, {side / 2, side * std::sqrt(.75)}};
  mesh.triangles = {{0, 1, 2}};
  return meshTimeStep(mesh, component);
}

double latticeSide(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += areaOf(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]);
  return std::sqrt(area / (std::sqrt(.1875) * static_cast<double>(mesh.triangles.size())));
}

std::string costlyStepWarning(const TriangleMesh& mesh, const Component& component, double size) {
  const double factor = latticeTimeStep(component, size) / meshTimeStep(mesh, component);
  if (factor < tolerance::kCostlyStep) return {};
  Shape worst{{}, 0, INFINITY};
  for (const auto& t : mesh.triangles) {
    const Shape shape = shapeOf(mesh, t);
    if (shape.altitude < worst.altitude) worst = shape;
  }
  return fmt::format(
      "the critical time step is {:.3g} times shorter than with even triangles of the size {:.4g} "
      "m, "
      "since at ({:g}, {:g}) the outline or a joint requires a triangle with an edge of {:.3g} m "
      "and a "
      "height of {:.3g} m.",
      factor, size, worst.centre.x, worst.centre.y, worst.shortest, worst.altitude);
}

}  // namespace yadefrag
