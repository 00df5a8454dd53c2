#include "elements/element_state.hpp"

namespace yadefrag {
namespace {

/// The gradient, in the stress-free shape, of a field with the given nodal values.
Matrix2 gradient(const Model& model, ElementId element, const std::vector<Vec2>& field,
                 const std::array<double, 4>& inverse) {
  const auto& nodes = model.triangles.nodes[element.value];
  const Vec2 d1 = field[nodes[1].value] - field[nodes[0].value];
  const Vec2 d2 = field[nodes[2].value] - field[nodes[0].value];
  return deformationGradient(d1.x, d1.y, d2.x, d2.y, inverse[0], inverse[1], inverse[2],
                             inverse[3]);
}

Matrix2 gradient(const Model& model, ElementId element, const std::vector<Vec2>& field) {
  return gradient(model, element, field, model.triangles.inverseEdges[element.value]);
}

/// σ = P Fᵀ / det F, with the stretch along the circle in det F. The barrier adds ∂B/∂J to its
/// mean.
std::array<double, 3> cauchy(const Deformation& now, const Moduli& m) {
  const Matrix2& f = now.plane;
  const Matrix2 p = hoopStress(f, now.hoop - 1, m.lame, m.shear).plane;
  const double det = now.volume();
  const double mean = CollapseBarrier(det, m.lame + 2 * m.shear).slope;
  return {(p.xx * f.xx + p.xy * f.xy) / det + mean, (p.yx * f.yx + p.yy * f.yy) / det + mean,
          (p.xx * f.yx + p.xy * f.yy) / det};
}

/// (Pa) σθθ = Pθ λθ / (det F λθ)
double cauchyAround(const Model& model, ElementId element) {
  const Moduli m(model.materialOf(element).material);
  const Deformation now = deformation(model, element);
  return hoopStress(now.plane, now.hoop - 1, m.lame, m.shear).hoop / determinant(now.plane) +
         CollapseBarrier(now.volume(), m.lame + 2 * m.shear).slope;
}

}  // namespace

Matrix2 deformationGradient(const Model& model, ElementId element) {
  return gradient(model, element, model.nodes.position);
}

std::array<double, 4> elasticEdges(const Model& model, ElementId element) {
  if (!model.bodyOf(element).yields()) return model.triangles.inverseEdges[element.value];
  return YieldPoint(model.triangles.plastic, element.value).edges;
}

Matrix2 elasticGradient(const Model& model, ElementId element) {
  return gradient(model, element, model.nodes.position, elasticEdges(model, element));
}

Matrix2 deformationStep(const Model& model, ElementId element, double dt) {
  const Matrix2 rate = gradient(model, element, model.nodes.velocity);
  return {dt * rate.xx, dt * rate.xy, dt * rate.yx, dt * rate.yy};
}

Deformation deformation(const Model& model, ElementId element) {
  return {deformationGradient(model, element), hoopStretch(model, element)};
}

Deformation deformationBefore(const Model& model, ElementId element, const Deformation& now,
                              double dt) {
  return {now.plane - deformationStep(model, element, dt),
          now.hoop - dt * overRadius(model, element, model.nodes.velocity, 0)};
}

std::array<double, 3> stressOf(const Model& model, ElementId element, double dt) {
  const Component& body = model.bodyOf(element);
  if (body.yields()) {
    const Returned state = presentState(model, element, dt);
    const double volume =
        body.material.planeStress ? state.trial.volume : deformation(model, element).volume();
    const PlaneStress t(state.trial, state.mean, state.kept, SolidModuli(body.material).shear);
    return {t.xx / volume, t.yy / volume, t.xy / volume};
  }
  return elasticStressOf(model, element, Moduli(model.materialOf(element).material));
}

std::array<double, 3> elasticStressOf(const Model& model, ElementId element, const Moduli& moduli) {
  return cauchy(deformation(model, element), moduli);
}

std::array<double, 3> strainRateOf(const Model& model, ElementId element) {
  const Matrix2 f = deformationGradient(model, element);
  const Matrix2 rate = gradient(model, element, model.nodes.velocity);
  const double det = determinant(f);
  return {(rate.xx * f.yy - rate.xy * f.yx) / det, (rate.yy * f.xx - rate.yx * f.xy) / det,
          (rate.xy * f.xx - rate.xx * f.xy + rate.yx * f.yy - rate.yy * f.yx) / (2 * det)};
}

std::vector<std::array<double, 3>> stresses(const Model& model, double dt) {
  std::vector<std::array<double, 3>> result(model.triangles.size());
  for (const Component& c : model.components) {
    if (c.element == ElementKind::kSmoothed || c.yields()) continue;
    Moduli m(c.material);
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      m.take(model, c, ElementId(e));
      result[e] = elasticStressOf(model, ElementId(e), m);
    }
  }
  setSmoothedStresses(model, result);
  setYieldingStresses(model, dt, result);
  return result;
}

std::vector<double> stressesAcross(const Model& model, double dt) {
  const std::vector<std::array<double, 3>> plane = stresses(model, dt);
  std::vector<double> result(plane.size());
  const std::vector<double>& initial = model.triangles.stressAcross;
  for (const Component& c : model.components) {
    if (c.yields() || c.material.planeStress) continue;
    for (std::size_t e = c.firstTriangle; e < c.lastTriangle; ++e) {
      if (model.triangles.isDropped(e)) continue;
      if (model.axisymmetric)
        result[e] = cauchyAround(model, ElementId(e));
      else
        result[e] = model.materialOf(ElementId(e)).material.poisson * (plane[e][0] + plane[e][1]) +
                    (initial.empty() ? 0 : initial[e]);
    }
  }
  if (model.axisymmetric) setSmoothedAround(model, result);
  setYieldingAcross(model, dt, result);
  return result;
}

}  // namespace yadefrag
