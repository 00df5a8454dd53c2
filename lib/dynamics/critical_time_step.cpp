#include "dynamics/critical_time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "dynamics/element_state.hpp"

namespace yadefrag {
namespace {

/// ω² of the fastest mode of one element with lumped mass. The elastic law is linear in F but for
/// the rotation, so its stiffness is that of the stress-free shape: only there do the gradients ∇N
/// of the shape functions count. With S = Σ∇N∇Nᵀ, tr S = Σl²/4A² and det S = 3/4A², the modes fall
/// into two pairs: stretches, and shear with rotation, which stiffens where the element is drawn
/// out.
double squaredFrequency(const ElasticMaterial& material, const std::array<double, 4>& inverse,
                        double area, const Matrix2& f) {
  const double lame = material.lame();
  const double shear = material.shearModulus();
  const Vec2 n1{inverse[0], inverse[1]};
  const Vec2 n2{inverse[2], inverse[3]};
  const Vec2 n0 = -(n1 + n2);
  const double trace = dot(n0, n0) + dot(n1, n1) + dot(n2, n2);
  const double det = .75 / (area * area);
  const double sum = (lame + 2 * shear) * trace;
  const double product = 4 * shear * (lame + shear) * det;
  const double stretch = (sum + std::sqrt(std::max(0., sum * sum - 4 * product))) / 2;
  const double drawn = std::hypot(f.xx + f.yy, f.yx - f.xy);  // 2 where there is no stretch
  const double turn = (shear + std::max(0., (lame + shear) * (1 - 2 / drawn))) * trace;
  return 3 / material.density * std::max(stretch, turn);
}

/// (1/s) The fastest decay rate of the element's bulk viscosity, of its present shape.
double viscousRate(const BulkViscosity& viscosity, const Model& model, ElementId element) {
  const ElasticMaterial& material =
      model.components[model.triangles.component[element.value].value].material;
  const auto& nodes = model.triangles.nodes[element.value];
  double squares = 0;
  double longest = 0;
  double growth = 0;  // of twice the area, m²/s
  std::array<Vec2, 3> x;
  for (int i = 0; i < 3; ++i) x[i] = model.nodes.position[nodes[i].value];
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
    squares += dot(edge, edge);
    longest = std::max(longest, norm(edge));
    growth -= dot(model.nodes.velocity[nodes[i].value], rightOf(edge));
  }
  const double twiceArea = cross(x[1] - x[0], x[2] - x[0]);
  const double length = twiceArea / longest;
  const double squeezed = std::max(0., -growth / twiceArea);
  const double wave = std::sqrt(material.waveModulus() / material.density);
  const double kinematic = length * (viscosity.linear * wave +
                                     viscosity.quadratic * viscosity.quadratic * length * squeezed);
  // The mass is that of the stress-free shape, the volume the present one.
  const double volumes = twiceArea / 2 / model.triangles.area[element.value];
  return 3 * kinematic * squares / (twiceArea * twiceArea) * volumes;
}

}  // namespace

double criticalTimeStep(const Model& model, const BulkViscosity& viscosity, int threads) {
  const Triangles& triangles = model.triangles;
  std::vector<double> least(std::max(1, threads), std::numeric_limits<double>::infinity());
  forEachPart(triangles.size(), threads, [&](std::size_t begin, std::size_t end, int part) {
    double step = least[part];
    for (std::size_t e = begin; e < end; ++e) {
      const ElementId id(e);
      const double omega = std::sqrt(squaredFrequency(
          model.components[triangles.component[e].value].material, triangles.inverseEdges[e],
          triangles.area[e], deformationGradient(model, id)));
      const double zeta = viscosity.isOn() ? viscousRate(viscosity, model, id) / (2 * omega) : 0;
      step = std::min(step, 2 / omega * (std::sqrt(1 + zeta * zeta) - zeta));
    }
    least[part] = step;
  });
  return *std::min_element(least.begin(), least.end());
}

}  // namespace yadefrag
