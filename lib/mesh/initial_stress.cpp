#include "mesh/initial_stress.hpp"

#include <cmath>

#include "core/tolerances/mesh.hpp"

namespace yadefrag {

/// In principal directions σ₁ = P₁/s₂ and σ₂ = P₂/s₁, where P is a function of the stretches s: two
/// linear equations for s₁ − 1 and s₂ − 1.
std::optional<std::array<double, 3>> stretchOf(const ElasticMaterial& material,
                                               const std::array<double, 3>& stress) {
  const double modulus = material.waveModulus(), lame = material.lame();
  const double mean = (stress[0] + stress[1]) / 2, half = (stress[0] - stress[1]) / 2;
  const double radius = std::hypot(half, stress[2]);
  const double s1 = mean + radius, s2 = mean - radius;
  const double det = modulus * modulus - (lame - s1) * (lame - s2);
  const double e1 = (modulus * s1 - (lame - s1) * s2) / det;
  const double e2 = (modulus * s2 - (lame - s2) * s1) / det;
  for (const double e : {e1, e2})
    if (!(std::abs(e) <= tolerance::kMostStretch)) return std::nullopt;
  const double middle = (e1 + e2) / 2;
  if (radius == 0) return std::array{1 + middle, 1 + middle, 0.};
  const double turned = (e1 - e2) / (2 * radius);
  return std::array{1 + middle + turned * half, 1 + middle - turned * half, turned * stress[2]};
}

/// F = d·D⁻¹ is the stretch S for the present edges d: D⁻¹ = d⁻¹·S.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch) {
  const auto [xx, yy, xy] = stretch;
  auto& i = triangles.inverseEdges[element.value];
  i = {i[0] * xx + i[1] * xy, i[0] * xy + i[1] * yy, i[2] * xx + i[3] * xy, i[2] * xy + i[3] * yy};
  triangles.area[element.value] /= xx * yy - xy * xy;
}

}  // namespace yadefrag
