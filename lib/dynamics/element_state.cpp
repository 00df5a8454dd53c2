#include "dynamics/element_state.hpp"

#include "dynamics/smoothed_state.hpp"

namespace yadefrag {
namespace {

/// The gradient, in the stress-free shape, of a field with the given nodal values.
Matrix2 gradient(const Model& model, ElementId element, const std::vector<Vec2>& field) {
  const auto& nodes = model.triangles.nodes[element.value];
  const auto& inverse = model.triangles.inverseEdges[element.value];
  const Vec2 d1 = field[nodes[1].value] - field[nodes[0].value];
  const Vec2 d2 = field[nodes[2].value] - field[nodes[0].value];
  return deformationGradient(d1.x, d1.y, d2.x, d2.y, inverse[0], inverse[1], inverse[2],
                             inverse[3]);
}

/// σ = P Fᵀ / det F
std::array<double, 3> cauchy(const Matrix2& p, const Matrix2& f) {
  const double det = determinant(f);
  return {(p.xx * f.xx + p.xy * f.xy) / det, (p.yx * f.yx + p.yy * f.yy) / det,
          (p.xx * f.yx + p.xy * f.yy) / det};
}

}  // namespace

Matrix2 deformationGradient(const Model& model, ElementId element) {
  return gradient(model, element, model.nodes.position);
}

Matrix2 deformationStep(const Model& model, ElementId element, double dt) {
  const Matrix2 rate = gradient(model, element, model.nodes.velocity);
  return {dt * rate.xx, dt * rate.xy, dt * rate.yx, dt * rate.yy};
}

std::array<double, 3> stressOf(const Model& model, ElementId element) {
  const ElasticMaterial& material = model.materialOf(element).material;
  const Matrix2 f = deformationGradient(model, element);
  return cauchy(firstPiola(f, material.lame(), material.shearModulus()), f);
}

std::vector<std::array<double, 3>> stresses(const Model& model) {
  std::vector<std::array<double, 3>> result(model.triangles.size());
  for (const Component& c : model.components) {
    if (c.element == ElementKind::kSmoothed) continue;
    Moduli m(c.material);
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      m.take(model, c, ElementId(e));
      const Matrix2 f = deformationGradient(model, ElementId(e));
      result[e] = cauchy(firstPiola(f, m.lame, m.shear), f);
    }
  }
  setSmoothedStresses(model, result);
  return result;
}

std::vector<double> elementEnergies(const Model& model) {
  std::vector<double> result(model.triangles.size());
  for (const Component& c : model.components) {
    if (c.element == ElementKind::kSmoothed) continue;
    Moduli m(c.material);
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      m.take(model, c, ElementId(e));
      result[e] = c.thickness * model.triangles.area[e] *
                  energyDensity(deformationGradient(model, ElementId(e)), m.lame, m.shear);
    }
  }
  setSmoothedEnergies(model, result);
  return result;
}

}  // namespace yadefrag
