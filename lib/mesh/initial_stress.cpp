#include "mesh/initial_stress.hpp"

#include <cmath>

#include "core/lane_math.hpp"
#include "core/tolerances/mesh.hpp"

namespace yadefrag {
namespace {

/// The tensor with these principal values, in the directions of `stress`.
std::array<double, 3> turned(const std::array<double, 3>& stress, double radius, double first,
                             double second) {
  const double middle = (first + second) / 2, half = (stress[0] - stress[1]) / 2;
  if (radius == 0) return {middle, middle, 0};
  const double by = (first - second) / (2 * radius);
  return {middle + by * half, middle - by * half, by * stress[2]};
}

bool isSmall(double strain) { return std::abs(strain) <= tolerance::kMostStretch; }

}  // namespace

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
  if (!isSmall(e1) || !isSmall(e2)) return std::nullopt;
  return turned(stress, radius, 1 + e1, 1 + e2);
}

/// In principal directions σ det F = κ (J² − 1)/2 + 2μe, where det F is that in the plane.
std::optional<SpatialStretch> stretchOf(const ElasticMaterial& material,
                                        const std::array<double, 3>& stress, double across) {
  const double bulk = material.young / (3 * (1 - 2 * material.poisson));
  const double shear = material.shearModulus();
  const double middle = (stress[0] + stress[1]) / 2;
  const double radius = std::hypot((stress[0] - stress[1]) / 2, stress[2]);
  const double mean = (2 * middle + across) / 3;
  double size = 1, last = 0;
  std::array<double, 3> stretches{};
  for (int i = 0; i < tolerance::kStretches && size != last; ++i) {
    const double squared = 1 + 2 * size * mean / bulk;  // J²
    if (!(squared > 0)) return std::nullopt;
    const auto stretchAt = [&](double one) {
      return expOf(size * (one - mean) / (2 * shear) + logOf(squared) / 6);
    };
    stretches = {stretchAt(middle + radius), stretchAt(middle - radius), stretchAt(across)};
    last = size, size = stretches[0] * stretches[1];
    for (const double one : stretches)
      if (!isSmall(one - 1)) return std::nullopt;
  }
  return SpatialStretch{turned(stress, radius, stretches[0], stretches[1]), stretches[2]};
}

/// F = d·D⁻¹ is the stretch S for the present edges d: D⁻¹ = d⁻¹·S.
void stretch(Triangles& triangles, ElementId element, const std::array<double, 3>& stretch) {
  const auto [xx, yy, xy] = stretch;
  auto& i = triangles.inverseEdges[element.value];
  i = {i[0] * xx + i[1] * xy, i[0] * xy + i[1] * yy, i[2] * xx + i[3] * xy, i[2] * xy + i[3] * yy};
  triangles.area[element.value] /= xx * yy - xy * xy;
}

}  // namespace yadefrag
