#include "time/critical_time_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "core/tolerances/dynamics.hpp"
#include "core/tolerances/mesh.hpp"
#include "elements/element_state.hpp"
#include "mesh/assembly.hpp"
#include "meshing/triangle_quality.hpp"

namespace yadefrag {
namespace {

/// (1/m) Gradients ∇N of the shape functions in the stress-free shape.
std::array<Vec2, 3> gradients(const Model& model, std::size_t element) {
  const auto inverse = elasticEdges(model, ElementId(element));
  const Vec2 n1{inverse[0], inverse[1]};
  const Vec2 n2{inverse[2], inverse[3]};
  return {-(n1 + n2), n1, n2};
}

const Component& componentOf(const Model& model, std::size_t element) {
  return model.bodyOf(ElementId(element));
}

const ElasticMaterial& elasticOf(const Model& model, std::size_t element) {
  return model.materialOf(ElementId(element)).material;
}

/// (N/m) Stiffness of an element at each of its corners.
std::array<double, 3> cornerStiffness(const Model& model, std::size_t element) {
  const double modulus = elasticOf(model, element).waveModulus() *
                         model.depthOf(ElementId(element)) * model.triangles.area[element];
  std::array<double, 3> stiffness;
  const auto gradient = gradients(model, element);
  for (int i = 0; i < 3; ++i) stiffness[i] = modulus * dot(gradient[i], gradient[i]);
  return stiffness;
}

/// (N/m) By node: the sum over its elements.
std::vector<double> nodeStiffness(const Model& model) {
  std::vector<double> sum(model.nodes.size(), 0);
  for (std::size_t e = 0; e < model.triangles.size(); ++e) {
    const auto stiffness = cornerStiffness(model, e);
    for (int i = 0; i < 3; ++i) sum[model.triangles.nodes[e][i].value] += stiffness[i];
  }
  return sum;
}

using Masses = std::array<double, 3>;

/// (of the element's mass) The element's parts of its nodes' masses. They are its own if the
/// element may separate from its neighbours by cracks, since the time step must then be stable for
/// it alone. As ratios, their products do not overflow.
Masses massShares(const Model& model, const std::vector<double>& nodeStiffness,
                  std::size_t element) {
  const Component& c = componentOf(model, element);
  const ElementId e(element);
  if (c.brittle.cracks())
    return {model.massShare(e, 0) / 3, model.massShare(e, 1) / 3, model.massShare(e, 2) / 3};
  const double own =
      elasticOf(model, element).density * model.depthOf(e) * model.triangles.area[element];
  Masses shares = cornerStiffness(model, element);
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t n = model.triangles.nodes[element][i].value;
    shares[i] *= model.nodes.mass[n] / own / nodeStiffness[n];
  }
  return shares;
}

/// (1/s²) Bound of ω² of the barrier against collapse, with a margin: of its curvature along ∇J,
/// and of its slope, as the largest curvature of J is √3/(2A). `round` (1/m): the part of the hoop
/// stretch of a node's x.
double squaredBarrierFrequency(const ElasticMaterial& material, const Deformation& now,
                               double round, const std::array<Vec2, 3>& gradient,
                               const Masses& mass) {
  const CollapseBarrier barrier(now.volume(), material.waveModulus());
  if (barrier.curvature == 0) return 0;
  const Matrix2 c = cofactor(now.plane);
  double sum = 0;  // Σ|∂J/∂xᵢ|²/m
  for (int i = 0; i < 3; ++i) {
    const Vec2 g{
        now.hoop * (c.xx * gradient[i].x + c.xy * gradient[i].y) + round * determinant(now.plane),
        now.hoop * (c.yx * gradient[i].x + c.yy * gradient[i].y)};
    sum += dot(g, g) / mass[i];
  }
  const double turn = now.hoop * std::sqrt(3.) * std::abs(cross(gradient[1], gradient[2])) /
                      std::min({mass[0], mass[1], mass[2]});
  return tolerance::kBarrierGrowth * (barrier.curvature * sum - barrier.slope * turn) /
         material.density;
}

/// (1/m) Hoop stretch per displacement of a corner along x.
double hoopSlope(const Model& model, std::size_t element) {
  return model.axisymmetric ? 1 / (3 * model.triangles.radius[element]) : 0;
}

/// (Pa/m²) What the strain along the circle around the axis adds at most, by its own stiffness: the
/// largest eigenvalue of a positive matrix is at most the sum of those of two diagonal blocks.
double aroundAxis(const Model& model, std::size_t element, const Masses& mass) {
  if (!model.axisymmetric) return 0;
  double slope = hoopSlope(model, element);
  if (componentOf(model, element).yields()) slope *= model.triangles.plastic.thickness[element];
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (!model.isOnAxis(model.triangles.nodes[element][i])) sum += 1 / mass[i];
  return elasticOf(model, element).waveModulus() * slope * slope * sum;
}

/// ω² of the highest mode of one element. The elastic law is linear in F except for the rotation,
/// so that its stiffness is that of the stress-free shape. With S = Σ∇N∇Nᵀ/m the modes are two
/// pairs: stretch modes, and shear with rotation, which is stiffer in a stretched element.
double squaredFrequency(const Model& model, std::size_t element, const Masses& mass) {
  const ElasticMaterial& material = elasticOf(model, element);
  const double lame = material.lame();
  const double shear = material.shearModulus();
  const auto gradient = gradients(model, element);
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (int i = 0; i < 3; ++i) {
    xx += gradient[i].x * gradient[i].x / mass[i];
    yy += gradient[i].y * gradient[i].y / mass[i];
    xy += gradient[i].x * gradient[i].y / mass[i];
  }
  const double trace = xx + yy;
  const double sum = (lame + 2 * shear) * trace;
  const double shape = (xx / trace) * (yy / trace) - (xy / trace) * (xy / trace);
  const double modulus = lame + 2 * shear;
  const double product = 4 * (shear / modulus) * ((lame + shear) / modulus) * shape;
  const double stretch = sum * (1 + std::sqrt(std::max(0., 1 - 4 * product))) / 2;
  const Matrix2 elastic = elasticGradient(model, ElementId(element));
  const double drawn =
      std::hypot(elastic.xx + elastic.yy, elastic.yx - elastic.xy);  // 2 without stretch
  const double turn = (shear + std::max(0., (lame + shear) * (1 - 2 / drawn))) * trace;
  return (std::max(stretch, turn) + aroundAxis(model, element, mass)) / material.density +
         squaredBarrierFrequency(material, deformation(model, ElementId(element)),
                                 hoopSlope(model, element), gradient, mass);
}

/// (1/s) The fastest decay rate of the element's bulk viscosity, in its present shape.
double viscousRate(const BulkViscosity& viscosity, const Model& model, std::size_t element,
                   const Masses& mass) {
  const ElasticMaterial& material = elasticOf(model, element);
  const auto& nodes = model.triangles.nodes[element];
  std::array<Vec2, 3> x;
  for (int i = 0; i < 3; ++i) x[i] = model.nodes.position[nodes[i].value];
  const double twiceArea = cross(x[1] - x[0], x[2] - x[0]);
  double longest = 0;
  double rate = 0;  // rate of the volume strain, 1/s
  double sum = 0;   // sum of |∇N|²/m
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
    longest = std::max(longest, norm(edge));
    rate -= dot(model.nodes.velocity[nodes[i].value], rightOf(edge)) / twiceArea;
    sum += dot(edge, edge) / (twiceArea * twiceArea * mass[i]);
  }
  const double length = twiceArea / longest;
  const double wave = std::sqrt(material.waveModulus() / material.density);
  const double squeeze = viscosity.quadratic * viscosity.quadratic * length * std::max(0., -rate);
  // The mass is that of the stress-free shape, the area the present one.
  return twiceArea / 2 / model.triangles.area[element] * length *
         (viscosity.linear * wave + squeeze) * sum;
}

/// Of a triangle.
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

double criticalTimeStep(const Model& model, const BulkViscosity& viscosity, int threads) {
  const std::vector<double> stiffness = nodeStiffness(model);
  std::vector<double> least(std::max(1, threads), std::numeric_limits<double>::infinity());
  forEachPart(model.triangles.size(), threads, [&](std::size_t begin, std::size_t end, int part) {
    double step = least[part];
    for (std::size_t e = begin; e < end; ++e) {
      if (model.triangles.isDropped(e)) continue;
      const Masses mass = massShares(model, stiffness, e);
      const double omega = std::sqrt(squaredFrequency(model, e, mass));
      const double zeta =
          viscosity.isOn() ? viscousRate(viscosity, model, e, mass) / (2 * omega) : 0;
      const double stable = 2 / omega / (std::hypot(1, zeta) + zeta);
      step = stable >= 0 ? std::min(step, stable) : 0;  // 0 if it is NaN
    }
    least[part] = step;
  });
  return *std::min_element(least.begin(), least.end());
}

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
